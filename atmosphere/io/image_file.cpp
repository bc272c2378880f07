#include <alpenglow/io/file.h>
#include <alpenglow/io/image_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include "atmosphere/io/exr_header.h"
#include "atmosphere/io/image_format.h"
#include "atmosphere/io/oiio.h"
#include "atmosphere/io/tone_curve.h"

namespace alpenglow::io {
namespace {

constexpr uint64_t kMaxImageBytes = uint64_t{1} << 30;

// Encodes in memory and writes the bytes at once, so that a full disk leaves no half picture.
Done writeImage(const std::string& path, const char* format, const OIIO::ImageSpec& spec,
                const void* pixels) try {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  const std::string name = std::string("memory.") + format;
  const bool good = output && output->set_ioproxy(&proxy) && output->open(name, spec) &&
                    output->write_image(spec.format, pixels) && output->close();
  if (!good) {
    const std::string reason = output ? output->geterror() : OIIO::geterror();
    return {"Cannot encode '" + path + "': " + oneLine(reason) + "."};
  }
  return writeFile(path, bytes.data(), bytes.size());
} catch (const std::exception& problem) {
  return {"Cannot encode '" + path + "': " + oneLine(problem.what()) + "."};
}

OIIO::ImageSpec rgbSpec(uint32_t width, uint32_t height, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3, type);
  spec.attribute("DateTime", "");  // Else the library adds the time, and no two files are equal.
  return spec;
}

uint8_t encodeLevel(float linear) {
  const float clamped = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
  return static_cast<uint8_t>(255.0f * tone::alpenglowSrgbEncode(clamped) + 0.5f);
}

// Bytes to linear light, and back by a table over the square root, which spreads the darks.
class SrgbCurve {
 public:
  SrgbCurve() {
    for (size_t i = 0; i < decode_.size(); ++i) {
      const double s = static_cast<double>(i) / 255.0;
      decode_[i] =
          static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    for (size_t i = 0; i < encode_.size(); ++i) {
      const float root = static_cast<float>(i) / static_cast<float>(encode_.size() - 1);
      encode_[i] = encodeLevel(root * root);
    }
  }
  float decode(uint8_t level) const { return decode_[level]; }
  uint8_t encode(float linear) const {
    const float place = std::sqrt(linear) * static_cast<float>(encode_.size() - 1) + 0.5f;
    return encode_[std::min(static_cast<size_t>(place), encode_.size() - 1)];
  }

 private:
  std::array<float, 256> decode_ = {};
  std::array<uint8_t, 8192> encode_ = {};
};

// Each texel is the mean of the 2x2 that it covers; an odd last row or column is left out.
AlbedoMap::Level halved(const AlbedoMap::Level& fine, const SrgbCurve& curve) {
  AlbedoMap::Level coarse;
  coarse.width = std::max(1u, fine.width / 2);
  coarse.height = std::max(1u, fine.height / 2);
  coarse.rgba.assign(size_t{coarse.width} * coarse.height * 4, 255);
  const auto texel = [&](uint32_t x, uint32_t y, uint32_t c) {
    const size_t at =
        size_t{std::min(y, fine.height - 1)} * fine.width + std::min(x, fine.width - 1);
    return curve.decode(fine.rgba[at * 4 + c]);
  };
  for (uint32_t y = 0; y < coarse.height; ++y) {
    for (uint32_t x = 0; x < coarse.width; ++x) {
      for (uint32_t c = 0; c < 3; ++c) {
        const float sum = texel(2 * x, 2 * y, c) + texel(2 * x + 1, 2 * y, c) +
                          texel(2 * x, 2 * y + 1, c) + texel(2 * x + 1, 2 * y + 1, c);
        coarse.rgba[(size_t{y} * coarse.width + x) * 4 + c] = curve.encode(0.25f * sum);
      }
    }
  }
  return coarse;
}

AlbedoMap::Level spread(const std::vector<uint8_t>& texels, uint32_t width, uint32_t height,
                        uint32_t channels) {
  AlbedoMap::Level level{width, height, std::vector<uint8_t>(size_t{width} * height * 4, 255)};
  for (size_t i = 0; i < size_t{width} * height; ++i) {
    for (uint32_t c = 0; c < 3; ++c) {
      level.rgba[i * 4 + c] = texels[i * channels + (channels >= 3 ? c : 0)];
    }
  }
  return level;
}

std::vector<uint8_t> encoded(const std::vector<float>& linear) {
  std::vector<uint8_t> bytes(linear.size());
  std::transform(linear.begin(), linear.end(), bytes.begin(), encodeLevel);
  return bytes;
}

Result<AlbedoMap> decodeAlbedo(const std::string& path, const std::string& bytes) {
  using Map = Result<AlbedoMap>;
  const char* format = imageFormatOf(bytes);
  if (format == nullptr) {
    return Map::failure("The albedo map '" + path + "' is no JPEG, PNG, TIFF or EXR image.");
  }
  constexpr uint64_t kMaxTexels = uint64_t{kMaxAlbedoWidth} * kMaxAlbedoHeight;
  const std::string damage = imageDamage(format, bytes, kMaxTexels);
  if (!damage.empty()) return Map::failure("The albedo map '" + path + "' " + damage + ".");
  MemoryInput memory(bytes, format);
  const auto unreadable = [&](const std::string& reason) {
    return Map::failure("Cannot read the albedo map '" + path + "': " + oneLine(reason) + ".");
  };
  if (!memory.input) return unreadable(memory.error);
  const OIIO::ImageSpec spec = memory.input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 ||
      spec.nchannels > 64 || spec.width > static_cast<int>(kMaxAlbedoWidth) ||
      spec.height > static_cast<int>(kMaxAlbedoHeight)) {
    return Map::failure("The albedo map '" + path + "' has " + std::to_string(spec.width) + "x" +
                        std::to_string(spec.height) + " texels; at most " +
                        std::to_string(kMaxAlbedoWidth) + "x" + std::to_string(kMaxAlbedoHeight) +
                        " are read.");
  }
  const int channels = spec.nchannels >= 3 ? 3 : 1;
  const size_t count = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                       static_cast<size_t>(channels);
  std::vector<uint8_t> texels;
  bool good = false;
  if (spec.format.is_floating_point()) {
    std::vector<float> linear(count);
    good = memory.input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, linear.data());
    if (good) texels = encoded(linear);
  } else {
    texels.resize(count);
    good = memory.input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, texels.data());
  }
  if (!good) return unreadable(memory.input->geterror());
  AlbedoMap map;
  map.levels.push_back(spread(texels, static_cast<uint32_t>(spec.width),
                              static_cast<uint32_t>(spec.height), static_cast<uint32_t>(channels)));
  addMipLevels(&map);
  return map;
}

}  // namespace

Done writeExr(const std::string& path, const LinearImage& image) {
  return writeImage(path, "openexr", rgbSpec(image.width, image.height, OIIO::TypeDesc::FLOAT),
                    image.pixels.data());
}

Done writePng(const std::string& path, const ByteImage& image) {
  OIIO::ImageSpec spec = rgbSpec(image.width, image.height, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  return writeImage(path, "png", spec, image.pixels.data());
}

Result<LinearImage> readExr(const std::string& path) try {
  using Image = Result<LinearImage>;
  const Result<std::string> bytes = readFile(path, kMaxImageBytes);
  if (!bytes) return Image::failure(bytes.error);
  if (bytes->compare(0, 4, "\x76\x2F\x31\x01") != 0) {
    return Image::failure("The picture '" + path + "' is no EXR image.");
  }
  const std::string damage = checkExrHeaders(*bytes, uint64_t{1} << 28, 64);
  if (!damage.empty()) return Image::failure("The picture '" + path + "' " + damage + ".");
  MemoryInput memory(*bytes, "openexr");
  const auto unreadable = [&](const std::string& reason) {
    return Image::failure("Cannot read the picture '" + path + "': " + oneLine(reason) + ".");
  };
  if (!memory.input) return unreadable(memory.error);
  const OIIO::ImageSpec spec = memory.input->spec();
  constexpr int kMaxSide = 16384;
  if (spec.nchannels < 3 || spec.width < 1 || spec.height < 1 || spec.width > kMaxSide ||
      spec.height > kMaxSide) {
    return unreadable("three channels and at most 16384x16384 pixels were expected");
  }
  LinearImage image{static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height), {}};
  image.pixels.resize(size_t{image.width} * image.height * 3);
  if (!memory.input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, image.pixels.data())) {
    return unreadable(memory.input->geterror());
  }
  return image;
} catch (const std::exception& problem) {
  return Result<LinearImage>::failure("Cannot read the picture '" + path +
                                      "': " + oneLine(problem.what()) + ".");
}

Result<AlbedoMap> readAlbedoMap(const std::string& path) try {
  const Result<std::string> bytes = readFile(path, kMaxImageBytes);
  if (!bytes) return Result<AlbedoMap>::failure(bytes.error);
  return decodeAlbedo(path, *bytes);
} catch (const std::exception& problem) {
  return Result<AlbedoMap>::failure("Cannot read the albedo map '" + path +
                                    "': " + oneLine(problem.what()) + ".");
}

void addMipLevels(AlbedoMap* map) {
  const SrgbCurve curve;
  while (map->levels.back().width > 1 || map->levels.back().height > 1) {
    AlbedoMap::Level next = halved(map->levels.back(), curve);
    map->levels.push_back(std::move(next));
  }
}

}  // namespace alpenglow::io
