#include <alpenglow/io/file.h>
#include <alpenglow/io/table_file.h>
#include <alpenglow/version.h>

#include <exception>
#include <string_view>

#include "atmosphere/io/atmosphere_json.h"
#include "atmosphere/io/exr_header.h"
#include "atmosphere/io/oiio.h"
#include "atmosphere/io/table_format.h"

namespace alpenglow::io {
namespace {

constexpr uint64_t kMaxFileBytes = uint64_t{4} << 30;
constexpr std::string_view kExrMagic = "\x76\x2F\x31\x01";

using Failed = Result<TableFile>;

Failed refuse(const std::string& path, const std::string& why) {
  return Failed::failure("The table file '" + path + "' " + why + ".");
}

// Each fills its share of a file from the attributes; empty, or what is wrong.
std::string readOrigin(const OIIO::ImageSpec& spec) {
  const int format = spec.get_int_attribute(kFormatAttribute, -1);
  if (format != kTableFileFormat) {
    return "has format " + std::to_string(format) + "; this version reads format " +
           std::to_string(kTableFileFormat);
  }
  const std::string version = spec.get_string_attribute(kVersionAttribute);
  if (version != ALPENGLOW_VERSION_STRING) {
    return "was baked by version '" + oneLine(version) +
           "'; this is version " ALPENGLOW_VERSION_STRING ", so bake it again";
  }
  return {};
}

std::string readStandard(const OIIO::ImageSpec& spec, TableDesc* desc) {
  const std::string mie = spec.get_string_attribute(kMieAttribute);
  if (mie != "full" && mie != "packed")
    return "names the unknown Mie storage '" + oneLine(mie) + "'";
  desc->mie = mie == "full" ? MieStorage::Full : MieStorage::Packed;
  if (!parseTransmittanceSize(spec.get_string_attribute(kTransmittanceAttribute), &desc->sizes) ||
      !parseIrradianceSize(spec.get_string_attribute(kIrradianceAttribute), &desc->sizes) ||
      !parseScatteringSize(spec.get_string_attribute(kScatteringAttribute), &desc->sizes)) {
    return "doesn't say the sizes of its tables";
  }
  return {};
}

std::string readMoments(const OIIO::ImageSpec& spec, TableDesc* desc) {
  const std::string quality = spec.get_string_attribute(kQualityAttribute);
  const std::optional<Quality> found = findQuality(quality);
  if (!found) return "names the unknown quality '" + oneLine(quality) + "'";
  desc->quality = *found;
  const Done done = parseMomentSettings(spec.get_string_attribute(kMomentsAttribute), &desc->sizes);
  return done ? "" : "is refused: " + oneLine(done.error);
}

std::string readDescription(const OIIO::ImageSpec& spec, TableDesc* desc) {
  const std::string solver = spec.get_string_attribute(kSolverAttribute);
  const std::optional<Solver> found = findSolver(solver);
  if (!found) return "names the unknown solver '" + oneLine(solver) + "'";
  desc->solver = *found;
  const int orders = spec.get_int_attribute(kOrdersAttribute, -1);
  const int least = desc->solver == Solver::Moments ? 0 : 1;
  if (orders < least || orders > static_cast<int>(kMaxOrders)) {
    return "holds " + std::to_string(orders) + " orders";
  }
  desc->orders = static_cast<uint32_t>(orders);
  const std::string texels = spec.get_string_attribute(kTexelsAttribute);
  if (texels != "half" && texels != "float")
    return "names the unknown format '" + oneLine(texels) + "'";
  desc->format = texels == "half" ? TableFormat::Half : TableFormat::Float;
  std::string why =
      desc->solver == Solver::Moments ? readMoments(spec, desc) : readStandard(spec, desc);
  if (!why.empty()) return why;
  const Done done = checkSizes(*desc);
  return done ? "" : "is refused: " + oneLine(done.error);
}

std::string readParameters(const OIIO::ImageSpec& spec, Parameters* parameters) {
  const Result<Json> atmosphere =
      parseJson(spec.get_string_attribute(kAtmosphereAttribute), "its atmosphere");
  JsonErrors errors{"its atmosphere", {}};
  if (atmosphere) *parameters = atmosphereFromJson(&errors, *atmosphere, "");
  const std::string problem = atmosphere ? errors.first : atmosphere.error;
  return problem.empty() ? "" : "is refused: " + oneLine(problem);
}

std::string readAttributes(const OIIO::ImageSpec& spec, TableFile* file) {
  std::string why = readOrigin(spec);
  if (why.empty()) why = readDescription(spec, &file->desc);
  if (why.empty()) why = readParameters(spec, &file->parameters);
  return why;
}

// Compares a part's header with its expected shape, so that nothing is allocated for a wrong one.
bool hasShape(const OIIO::ImageSpec& spec, const TablePart& part, const TableDesc& desc) {
  return spec.nchannels == 4 && mayHaveFormat(part, desc) && spec.channelformats.empty() &&
         !spec.deep && spec.depth == 1 && spec.tile_width == 0 && spec.x == 0 && spec.y == 0 &&
         spec.width == static_cast<int>(part.width) &&
         spec.height == static_cast<int>(part.height * part.depth);
}

std::string readPart(OIIO::ImageInput* input, int index, bool keep, TableFile* file) {
  const std::vector<TablePart> expected = expectedParts(file->desc);
  const OIIO::ImageSpec spec = input->spec();
  const std::string name = spec.get_string_attribute("oiio:subimagename");
  const size_t at = static_cast<size_t>(index);
  std::optional<TablePart> part;
  if (at < expected.size()) {
    if (name == expected[at].name) part = expected[at];
  } else {
    part = orderPart(file->desc, name);
  }
  const std::string shown = std::string("'").append(oneLine(name)) + "'";
  if (!part) return "has a part " + shown + " that doesn't belong there";
  const bool isHalf = spec.format == OIIO::TypeDesc::HALF;
  part->format = isHalf ? TableFormat::Half : TableFormat::Float;
  if ((!isHalf && spec.format != OIIO::TypeDesc::FLOAT) || !hasShape(spec, *part, file->desc)) {
    return "has a part " + shown + " of another shape than its description says";
  }
  if (at >= expected.size() && !keep) return {};
  part->texels.resize(expectedBytes(*part));
  if (!input->read_image(index, 0, 0, 4, spec.format, part->texels.data())) {
    return "is damaged in its part " + shown + ": " + oneLine(input->geterror());
  }
  file->parts.push_back(std::move(*part));
  return {};
}

Failed decode(const std::string& path, const std::string& bytes, bool orders) {
  MemoryInput memory(bytes, "openexr");
  if (!memory.input) return refuse(path, "can't be opened: " + memory.error);
  TableFile file;
  if (std::string why = readAttributes(memory.input->spec(), &file); !why.empty()) {
    return refuse(path, why);
  }
  int index = 0;
  for (; memory.input->seek_subimage(index, 0); ++index) {
    if (std::string why = readPart(memory.input.get(), index, orders, &file); !why.empty()) {
      return refuse(path, why);
    }
  }
  memory.input->geterror();  // Of the part after the last: expected, and not to be left pending.
  if (static_cast<size_t>(index) < expectedParts(file.desc).size()) {
    return refuse(
        path, "lacks the part '" + expectedParts(file.desc)[static_cast<size_t>(index)].name + "'");
  }
  return file;
}

}  // namespace

Result<TableFile> readTableBytes(const std::string& path, std::string* bytes, bool orders) try {
  if (bytes->compare(0, kExrMagic.size(), kExrMagic) != 0) return refuse(path, "is no EXR file");
  const std::optional<size_t> digits = findChecksum(*bytes);
  if (!digits) return refuse(path, "has no checksum, so it is truncated or no table file");
  if (bytes->substr(*digits, kChecksumDigits) != checksum(bytes, *digits)) {
    return refuse(path, "is truncated or altered: its checksum is wrong");
  }
  const std::string problem = checkExrHeaders(*bytes, kMaxTableTexels, 4);
  if (!problem.empty()) return refuse(path, problem);
  return decode(path, *bytes, orders);
} catch (const std::exception& problem) {
  return refuse(path, "can't be read: " + oneLine(problem.what()));
}

Result<TableFile> readTableFile(const std::string& path, bool orders) {
  Result<std::string> bytes = readFile(path, kMaxFileBytes);
  if (!bytes) return Failed::failure(bytes.error);
  return readTableBytes(path, &*bytes, orders);
}

}  // namespace alpenglow::io
