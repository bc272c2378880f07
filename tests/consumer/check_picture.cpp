// check_picture FILE.ppm WIDTH HEIGHT: fails unless the picture that embed_minimal writes shows a
// sky by day: the right size, nothing black above the horizon, blue overhead, paler below.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;  // From the top left.
};

[[noreturn]] void fail(const std::string& sentence) {
  std::fprintf(stderr, "%s\n", sentence.c_str());
  std::exit(1);
}

Picture read(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int maximum = 0;
  Picture picture;
  file >> magic >> picture.width >> picture.height >> maximum;
  file.get();
  if (!file || magic != "P6" || maximum != 255) fail(std::string(path) + " is no 8-bit PPM.");
  picture.rgb.assign(std::istreambuf_iterator<char>(file), {});
  return picture;
}

// Mean colour of the rows [first, last).
std::array<double, 3> mean(const Picture& picture, int first, int last) {
  std::array<double, 3> sum = {};
  const int pixels = (last - first) * picture.width;
  for (int i = 0; i < pixels; ++i) {
    for (int c = 0; c < 3; ++c) {
      const auto at = static_cast<size_t>((first * picture.width + i) * 3 + c);
      sum[static_cast<size_t>(c)] += picture.rgb[at] / static_cast<double>(pixels);
    }
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) fail("Usage: check_picture FILE.ppm WIDTH HEIGHT");
  const Picture picture = read(argv[1]);
  if (picture.width != std::atoi(argv[2]) || picture.height != std::atoi(argv[3]) ||
      picture.rgb.size() != size_t(picture.width) * size_t(picture.height) * 3) {
    fail("The picture has " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
         " pixels and " + std::to_string(picture.rgb.size()) + " bytes, expected " + argv[2] + "x" +
         argv[3] + " and three bytes each.");
  }
  const std::array<double, 3> top = mean(picture, 0, picture.height / 8);
  // The camera looks 15 degrees up with a view of 60, so the horizon is 0.732 of the way down.
  const std::array<double, 3> low =
      mean(picture, picture.height * 62 / 100, picture.height * 70 / 100);
  std::printf("top %.1f %.1f %.1f, above the horizon %.1f %.1f %.1f\n", top[0], top[1], top[2],
              low[0], low[1], low[2]);
  if (top[2] < 40.0) fail("The sky is black overhead.");
  if (top[2] < 1.2 * top[0] || top[2] < top[1]) fail("The sky is not blue overhead.");
  if (low[0] <= top[0]) fail("The sky is not paler towards the horizon.");
  if (low[0] / low[2] <= top[0] / top[2]) fail("The horizon is bluer than the sky overhead.");
}
