#include <alpenglow/io/file.h>
#include <alpenglow/io/table_file.h>
#include <alpenglow/version.h>

#include <algorithm>
#include <exception>
#include <fstream>

#include "atmosphere/io/atmosphere_json.h"
#include "atmosphere/io/oiio.h"
#include "atmosphere/io/table_format.h"

namespace alpenglow::io {
namespace {

constexpr uint64_t kMaxFileBytes = uint64_t{4} << 30;

OIIO::TypeDesc texelType(TableFormat format) {
  return format == TableFormat::Half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

void describe(const TableFile& file, OIIO::ImageSpec* spec) {
  const TableDesc& desc = file.desc;
  spec->attribute(kFormatAttribute, kTableFileFormat);
  spec->attribute(kVersionAttribute, ALPENGLOW_VERSION_STRING);
  spec->attribute(kAtmosphereAttribute, atmosphereToJson(file.parameters).dump());
  spec->attribute(kSolverAttribute, solverName(desc.solver));
  spec->attribute(kOrdersAttribute, static_cast<int>(desc.orders));
  spec->attribute(kTexelsAttribute, desc.format == TableFormat::Half ? "half" : "float");
  if (desc.solver == Solver::Moments) {
    spec->attribute(kQualityAttribute, qualityName(desc.quality));
    spec->attribute(kMomentsAttribute, momentSettingsText(desc.sizes));
  } else {
    spec->attribute(kMieAttribute, desc.mie == MieStorage::Full ? "full" : "packed");
    spec->attribute(kTransmittanceAttribute, transmittanceSizeText(desc.sizes));
    spec->attribute(kIrradianceAttribute, irradianceSizeText(desc.sizes));
    spec->attribute(kScatteringAttribute, scatteringSizeText(desc.sizes));
  }
  spec->attribute(kChecksumAttribute, std::string(kChecksumDigits, '0'));
}

std::vector<OIIO::ImageSpec> specsOf(const TableFile& file) {
  std::vector<OIIO::ImageSpec> specs;
  int width = 0;
  int height = 0;
  for (const TablePart& part : file.parts) {
    OIIO::ImageSpec spec(static_cast<int>(part.width), static_cast<int>(part.height * part.depth),
                         4, texelType(part.format));
    spec.attribute("oiio:subimagename", part.name);
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // Else the library adds the time, and no two files are equal.
    width = std::max(width, spec.width);
    height = std::max(height, spec.height);
    specs.push_back(std::move(spec));
  }
  for (OIIO::ImageSpec& spec : specs) {  // EXR wants one display window for all parts.
    spec.full_width = width;
    spec.full_height = height;
  }
  describe(file, &specs.front());
  return specs;
}

Done checkPartition(const TableFile& file) {
  if (Done done = checkSizes(file.desc); !done) return done;
  if (file.desc.disabledEffects != 0 || file.desc.sunZenithFrom != 0.0 ||
      file.desc.sunZenithTo != 0.0) {
    return {
        "A table file holds whole tables alone, but this description leaves out effects or sun "
        "elevations."};
  }
  if (file.desc.solver == Solver::Moments && file.desc.quality == Quality::Default) {
    return {"A table file names its level of quality, but this description has none."};
  }
  std::vector<TablePart> expected = expectedParts(file.desc);
  for (size_t i = expected.size(); i < file.parts.size(); ++i) {
    const std::optional<TablePart> order = orderPart(file.desc, file.parts[i].name);
    if (!order) return {"A table file has no part named '" + file.parts[i].name + "'."};
    expected.push_back(*order);
  }
  if (file.parts.size() < expected.size()) {
    return {"The table '" + expected[file.parts.size()].name + "' is missing."};
  }
  for (size_t i = 0; i < expected.size(); ++i) {
    const TablePart& want = expected[i];
    const TablePart& have = file.parts[i];
    if (have.name != want.name || have.width != want.width || have.height != want.height ||
        have.depth != want.depth || !mayHaveFormat(have, file.desc) ||
        have.texels.size() != expectedBytes(have)) {
      return {"The table '" + have.name + "' doesn't have the shape of '" + want.name + "'."};
    }
  }
  return {};
}

Done encode(const std::string& path, const TableFile& file) {
  const std::vector<OIIO::ImageSpec> specs = specsOf(file);
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr");
  if (!output) return {oneLine(OIIO::geterror())};
  bool good = output->open(path, static_cast<int>(specs.size()), specs.data());
  for (size_t i = 0; good && i < specs.size(); ++i) {
    if (i > 0) good = output->open(path, specs[i], OIIO::ImageOutput::AppendSubimage);
    good = good && output->write_image(specs[i].format, file.parts[i].texels.data());
  }
  good = good && output->close();
  return {good ? "" : oneLine(output->geterror())};
}

// Puts the checksum into the file, then reads the file again: the image library reports no disk
// that filled up while it closed, and the checksum alone would cover up for a part that is missing.
Done sealAndVerify(const std::string& path, const TableFile& file) {
  Result<std::string> bytes = readFile(path, kMaxFileBytes);
  if (!bytes) return {bytes.error};
  const std::optional<size_t> digits = findChecksum(*bytes);
  if (!digits) return {"the checksum is missing"};
  const std::string sum = checksum(&*bytes, *digits);
  bytes->replace(*digits, kChecksumDigits, sum);
  std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(*digits));
  stream.write(sum.data(), static_cast<std::streamsize>(sum.size()));
  stream.close();
  if (!stream) return {"its checksum can't be written"};
  const Result<TableFile> again = readTableFile(path, true);
  if (!again) return {again.error};
  for (size_t i = 0; i < file.parts.size(); ++i) {
    if (i >= again->parts.size() || again->parts[i].format != file.parts[i].format ||
        again->parts[i].texels != file.parts[i].texels) {
      return {"the part '" + file.parts[i].name + "' reads back otherwise than it was written"};
    }
  }
  return {};
}

}  // namespace

Done writeTableFile(const std::string& path, const TableFile& file) try {
  if (Done done = checkPartition(file); !done) return done;
  Result<PendingFile> pending = PendingFile::create(path);
  if (!pending) return {pending.error};
  Done done = encode(pending->path(), file);
  if (done) done = sealAndVerify(pending->path(), file);
  if (!done) return {"Cannot write the table file '" + path + "': " + oneLine(done.error) + "."};
  return pending->commit();
} catch (const std::exception& problem) {
  return {"Cannot write the table file '" + path + "': " + oneLine(problem.what()) + "."};
}

}  // namespace alpenglow::io
