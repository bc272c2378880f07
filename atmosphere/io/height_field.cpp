#include <alpenglow/io/file.h>
#include <alpenglow/io/height_field.h>

#include <cmath>
#include <exception>

#include "atmosphere/io/image_format.h"
#include "atmosphere/io/json.h"
#include "atmosphere/io/oiio.h"

namespace alpenglow::io {
namespace {

// A file of the largest size, uncompressed, with 4 channels of 32 bits, and room for its headers.
constexpr uint64_t kMaxHeightBytes = (uint64_t{kMaxHeightSamples} * 16) + (uint64_t{16} << 20);

// What the image library would turn into other numbers than the file's; as the end of a sentence.
std::string unsuitable(const std::string& format, const std::string& bytes,
                       const OIIO::ImageSpec& spec) {
  int bits = spec.get_int_attribute("oiio:BitsPerSample", 8);
  if (format == "png" && bytes.size() > 25) {  // Both stand in the first chunk.
    bits = bytes[24];
    if (bytes[25] == 3) return "has a palette; grey or colour samples were expected";
  }
  if (bits % 8 != 0) {
    return "has " + std::to_string(bits) + " bits a sample; 8, 16 or 32 were expected";
  }
  return {};
}

std::string sizeError(const OIIO::ImageSpec& spec) {
  const int most = static_cast<int>(kMaxHeightSide);
  const bool one = spec.depth <= 1 && spec.nchannels >= 1 && spec.nchannels <= 64;
  const bool large = spec.width > most || spec.height > most ||
                     static_cast<int64_t>(spec.width) * spec.height > int64_t{kMaxHeightSamples};
  // The library allocates whole tiles, which the file may claim to be of any size.
  const int64_t tile = static_cast<int64_t>(spec.tile_width) * spec.tile_height;
  if (one && !large && spec.width >= 2 && spec.height >= 2 && tile <= int64_t{kMaxHeightSamples}) {
    return {};
  }
  return "has " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
         " samples; from 2x2 to " + std::to_string(kMaxHeightSide) + " along a side and " +
         std::to_string(kMaxHeightSamples) + " in all are read";
}

// The first channel as T, which is the file's own `type` or float, in metres. False: the library
// has an error.
template <typename T>
bool readChannel(OIIO::ImageInput* input, OIIO::TypeDesc::BASETYPE type, const HeightUnits& units,
                 HeightMap* map) {
  std::vector<T> samples(size_t{map->width} * map->height);
  if (!input->read_image(0, 0, 0, 1, type, samples.data())) return false;
  map->heights_m.resize(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    map->heights_m[i] =
        static_cast<float>(static_cast<double>(samples[i]) * units.metersPerUnit + units.offset_m);
  }
  return true;
}

bool readSamples(OIIO::ImageInput* input, const HeightUnits& units, HeightMap* map) {
  const auto type = static_cast<OIIO::TypeDesc::BASETYPE>(input->spec().channelformat(0).basetype);
  switch (type) {
    case OIIO::TypeDesc::UINT8:
      return readChannel<uint8_t>(input, type, units, map);
    case OIIO::TypeDesc::INT8:
      return readChannel<int8_t>(input, type, units, map);
    case OIIO::TypeDesc::UINT16:
      return readChannel<uint16_t>(input, type, units, map);
    case OIIO::TypeDesc::INT16:
      return readChannel<int16_t>(input, type, units, map);
    case OIIO::TypeDesc::UINT32:
      return readChannel<uint32_t>(input, type, units, map);
    case OIIO::TypeDesc::INT32:
      return readChannel<int32_t>(input, type, units, map);
    case OIIO::TypeDesc::DOUBLE:
      return readChannel<double>(input, type, units, map);
    default:
      return readChannel<float>(input, OIIO::TypeDesc::FLOAT, units, map);
  }
}

std::string notFinite(const HeightMap& map) {
  for (size_t i = 0; i < map.heights_m.size(); ++i) {
    if (!std::isfinite(map.heights_m[i])) {
      return "has a height of " + showNumber(double{map.heights_m[i]}) + " at column " +
             std::to_string(i % map.width) + ", row " + std::to_string(i / map.width) +
             ", where a finite number was expected";
    }
  }
  return {};
}

Result<HeightMap> decodeHeights(const std::string& path, const std::string& bytes,
                                const HeightUnits& units) {
  using Map = Result<HeightMap>;
  const auto refused = [&](const std::string& reason) {
    return Map::failure("The height map '" + path + "' " + reason + ".");
  };
  const auto unreadable = [&](const std::string& reason) {
    return Map::failure("Cannot read the height map '" + path + "': " + oneLine(reason) + ".");
  };
  const char* format = imageFormatOf(bytes);
  if (format == nullptr || format == std::string("jpeg")) {
    return refused("is no PNG, TIFF or EXR image");
  }
  const std::string damage = imageDamage(format, bytes, kMaxHeightSamples);
  if (!damage.empty()) return refused(damage);
  OIIO::ImageSpec asStored;
  asStored.attribute("oiio:UnassociatedAlpha", 1);  // Else heights are multiplied by alpha.
  MemoryInput memory(bytes, format, asStored);
  if (!memory.input) return unreadable(memory.error);
  const OIIO::ImageSpec spec = memory.input->spec();
  for (const std::string& reason : {sizeError(spec), unsuitable(format, bytes, spec)}) {
    if (!reason.empty()) return refused(reason);
  }
  HeightMap map{static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height), {}};
  if (!readSamples(memory.input.get(), units, &map)) return unreadable(memory.input->geterror());
  const std::string reason = notFinite(map);
  return reason.empty() ? Map(std::move(map)) : refused(reason);
}

}  // namespace

Result<HeightMap> readHeightMap(const std::string& path, const HeightUnits& units) try {
  using Map = Result<HeightMap>;
  if (!(units.metersPerUnit > 0.0 && std::isfinite(units.metersPerUnit))) {
    return Map::failure("HeightUnits::metersPerUnit is " + showNumber(units.metersPerUnit) +
                        ", but it must be above 0 and finite.");
  }
  if (!std::isfinite(units.offset_m)) {
    return Map::failure("HeightUnits::offset_m is " + showNumber(units.offset_m) +
                        ", but it must be finite.");
  }
  const Result<std::string> bytes = readFile(path, kMaxHeightBytes);
  if (!bytes) return Map::failure(bytes.error);
  return decodeHeights(path, *bytes, units);
} catch (const std::exception& problem) {
  return Result<HeightMap>::failure("Cannot read the height map '" + path +
                                    "': " + oneLine(problem.what()) + ".");
}

}  // namespace alpenglow::io
