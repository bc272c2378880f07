#include "atmosphere/io/table_format.h"

#include <OpenImageIO/hash.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <cstdio>
#include <iterator>
#include <string_view>

#include <alpenglow/table_limits.h>

namespace alpenglow::io {
namespace {

constexpr uint32_t kMomentLayers = 5;  // Of kTableMoments, below each other.
// The headers of a file stand at its start; the digits are never further in than this.
constexpr size_t kMaxHeaderBytes = size_t{1} << 20;

constexpr uint32_t TableSizes::*kSizes[] = {
    &TableSizes::depthMu,       &TableSizes::depthH,          &TableSizes::nodesR,
    &TableSizes::nodesMuS,      &TableSizes::zenithsSky,      &TableSizes::zenithsLimb,
    &TableSizes::zenithsGround, &TableSizes::azimuths,        &TableSizes::degree,
    &TableSizes::sourceGamma,   &TableSizes::sourcePsi,       &TableSizes::solverPanels,
    &TableSizes::viewPanels,    &TableSizes::transmittanceMu, &TableSizes::transmittanceR,
    &TableSizes::irradianceMuS, &TableSizes::irradianceR,     &TableSizes::scatteringR,
    &TableSizes::scatteringMu,  &TableSizes::scatteringMuS,   &TableSizes::scatteringNu,
    &TableSizes::stepCount};
static_assert(sizeof(TableSizes) == std::size(kSizes) * sizeof(uint32_t), "none is forgotten");

TablePart irradiancePart(const TableDesc& desc, const std::string& name) {
  return {name, desc.sizes.irradianceMuS, desc.sizes.irradianceR, 1, desc.format, {}};
}

TablePart scatteringPart(const TableDesc& desc, const std::string& name) {
  const TableSizes& sizes = desc.sizes;
  return {name,
          sizes.scatteringMuS * sizes.scatteringNu,
          sizes.scatteringMu,
          sizes.scatteringR,
          desc.format,
          {}};
}

TablePart momentsPart(const TableDesc& desc, const std::string& name) {
  const TableSizes& m = desc.sizes;
  return {name, fieldTexels(m.nodesMuS), fieldTexels(m.nodesR) * kMomentLayers, 1, desc.format, {}};
}

// Of a single order: the nodes alone.
TablePart orderMomentsPart(const TableDesc& desc, const std::string& name) {
  const TableSizes& m = desc.sizes;
  return {name, m.nodesMuS, m.nodesR * kMomentLayers, 1, desc.format, {}};
}

TablePart sourcePart(const TableDesc& desc, const std::string& name) {
  const TableSizes& m = desc.sizes;
  return {name, m.sourceGamma * m.sourcePsi, m.nodesMuS, m.nodesR, desc.format, {}};
}

Done checkTexels(const std::string& what, std::initializer_list<uint32_t> sides) {
  uint64_t texels = 1;
  for (const uint32_t side : sides) texels *= side;  // At most kMaxTableSide^4, which fits.
  if (texels <= kMaxTableTexels) return {};
  return {"The size " + what + " has " + std::to_string(texels) + " texels; at most " +
          std::to_string(kMaxTableTexels) + " are allowed."};
}

Done checkMomentSizes(const TableSizes& m) {
  Done done = checkMomentSettings(m);
  if (done) done = checkTexels("of the optical depth", {m.depthMu, m.depthH});
  if (done)
    done = checkTexels("of the moments",
                       {fieldTexels(m.nodesMuS), fieldTexels(m.nodesR), kMomentLayers});
  if (done) done = checkTexels("of the source", {m.sourceGamma, m.sourcePsi, m.nodesMuS, m.nodesR});
  return done;
}

Done checkStandardSizes(const TableSizes& s) {
  const std::pair<const char*, uint32_t> sides[] = {
      {"mu of the transmittance", s.transmittanceMu}, {"r of the transmittance", s.transmittanceR},
      {"mu_s of the irradiance", s.irradianceMuS},    {"r of the irradiance", s.irradianceR},
      {"r of the scattering", s.scatteringR},         {"mu of the scattering", s.scatteringMu},
      {"mu_s of the scattering", s.scatteringMuS},    {"nu of the scattering", s.scatteringNu}};
  for (const auto& [name, size] : sides) {
    if (size < 2 || size > kMaxTableSide) {
      return {"The size " + std::to_string(size) + " for " + name +
              " is out of bounds; it must be from 2 to " + std::to_string(kMaxTableSide) + "."};
    }
  }
  if (s.scatteringMu < 4 || s.scatteringMu % 2 != 0) {
    return {"The size " + std::to_string(s.scatteringMu) +
            " for mu of the scattering must be even and at least 4."};
  }
  return checkTexels(scatteringSizeText(s) + " of the scattering",
                     {s.scatteringR, s.scatteringMu, s.scatteringMuS, s.scatteringNu});
}

std::vector<TablePart> momentParts(const TableDesc& desc) {
  const TableSizes& m = desc.sizes;
  return {{"optical_depth", m.depthMu, m.depthH, 1, desc.format, {}},
          momentsPart(desc, "moments"),
          sourcePart(desc, "source")};
}

std::vector<TablePart> standardParts(const TableDesc& desc) {
  const TableSizes& sizes = desc.sizes;
  std::vector<TablePart> parts = {
      {"optical_depth", sizes.transmittanceMu, sizes.transmittanceR, 1, desc.format, {}},
      irradiancePart(desc, "irradiance"),
      scatteringPart(desc, "scattering")};
  if (desc.mie == MieStorage::Full) parts.push_back(scatteringPart(desc, "single_mie"));
  return parts;
}

std::optional<TablePart> partOfOrder(const TableDesc& desc, const std::string& name,
                                     uint32_t order) {
  const std::string suffix = "_order_" + std::to_string(order);
  if (desc.solver == Solver::Moments) {
    // The light of an order is solved for the source of the next. The last one's isn't needed.
    const bool last = order == desc.orders;
    if (name == "moments" + suffix && !last) return orderMomentsPart(desc, name);
    if (name == "source" + suffix && order > 1) return sourcePart(desc, name);
    return std::nullopt;
  }
  if (name == "irradiance" + suffix) return irradiancePart(desc, name);
  if (name == "scattering" + suffix) return scatteringPart(desc, name);
  if (order == 1 && name == "single_mie" + suffix) return scatteringPart(desc, name);
  return std::nullopt;
}

OIIO::TypeDesc typeOf(TableFormat format) {
  return format == TableFormat::Half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

// "AxBxC..." of exactly `count` whole numbers from 1 to kMaxTableSide.
bool parseNumbers(const std::string& text, size_t count, uint32_t* numbers) {
  size_t at = 0;
  for (size_t i = 0; i < count; ++i) {
    const size_t start = at;
    uint32_t value = 0;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9' && value <= kMaxTableSide) {
      value = value * 10 + static_cast<uint32_t>(text[at] - '0');
      ++at;
    }
    if (at == start || value < 1 || value > kMaxTableSide) return false;
    numbers[i] = value;
    if (i + 1 < count && (at >= text.size() || text[at++] != 'x')) return false;
  }
  return at == text.size();
}

std::string times(std::initializer_list<uint32_t> numbers) {
  std::string text;
  for (const uint32_t number : numbers) {
    if (!text.empty()) text += 'x';
    text += std::to_string(number);
  }
  return text;
}

}  // namespace

const TablePart* TableFile::find(const std::string& name) const {
  for (const TablePart& candidate : parts) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
}

TableDesc resolved(TableDesc desc, const Parameters& parameters) {
  // A size that is out of bounds stays as it is: checkSizes has a sentence for it.
  TableDesc full = desc;
  full.sizes = {};
  if (resolveTableDesc(parameters, &full, {}) != Status::Ok) return desc;
  for (const auto size : kSizes)
    if (desc.sizes.*size != 0) full.sizes.*size = desc.sizes.*size;
  return full;
}

Done checkSizes(const TableDesc& desc) {
  return desc.solver == Solver::Moments ? checkMomentSizes(desc.sizes)
                                        : checkStandardSizes(desc.sizes);
}

std::vector<TablePart> expectedParts(const TableDesc& desc) {
  return desc.solver == Solver::Moments ? momentParts(desc) : standardParts(desc);
}

std::optional<TablePart> orderPart(const TableDesc& desc, const std::string& name) {
  const uint32_t orders = desc.orders == 0 ? kMaxOrders : desc.orders;  // 0: as many as it took.
  for (uint32_t order = 1; order <= orders; ++order) {
    if (std::optional<TablePart> part = partOfOrder(desc, name, order)) return part;
  }
  return std::nullopt;
}

bool mayHaveFormat(const TablePart& part, const TableDesc& desc) {
  if (part.format == desc.format || part.name == "optical_depth") return true;
  return part.name.rfind("moments", 0) == 0;
}

size_t expectedBytes(const TablePart& part) {
  return size_t{part.width} * part.height * part.depth *
         (part.format == TableFormat::Half ? 8 : 16);
}

void convertTexels(TablePart* part, TableFormat format) {
  if (part->format == format) return;
  const OIIO::TypeDesc from = typeOf(part->format);
  part->format = format;
  std::vector<uint8_t> converted(expectedBytes(*part));
  OIIO::convert_pixel_values(from, part->texels.data(), typeOf(format), converted.data(),
                             static_cast<int>(part->texels.size() / from.size()));
  part->texels = std::move(converted);
}

std::string transmittanceSizeText(const TableSizes& sizes) {
  return times({sizes.transmittanceMu, sizes.transmittanceR});
}

std::string irradianceSizeText(const TableSizes& sizes) {
  return times({sizes.irradianceMuS, sizes.irradianceR});
}

std::string scatteringSizeText(const TableSizes& sizes) {
  return times({sizes.scatteringR, sizes.scatteringMu, sizes.scatteringMuS, sizes.scatteringNu});
}

bool parseTransmittanceSize(const std::string& text, TableSizes* sizes) {
  uint32_t n[2] = {};
  if (!parseNumbers(text, 2, n)) return false;
  sizes->transmittanceMu = n[0];
  sizes->transmittanceR = n[1];
  return true;
}

bool parseIrradianceSize(const std::string& text, TableSizes* sizes) {
  uint32_t n[2] = {};
  if (!parseNumbers(text, 2, n)) return false;
  sizes->irradianceMuS = n[0];
  sizes->irradianceR = n[1];
  return true;
}

bool parseScatteringSize(const std::string& text, TableSizes* sizes) {
  uint32_t n[4] = {};
  if (!parseNumbers(text, 4, n)) return false;
  sizes->scatteringR = n[0];
  sizes->scatteringMu = n[1];
  sizes->scatteringMuS = n[2];
  sizes->scatteringNu = n[3];
  return true;
}

std::optional<size_t> findChecksum(const std::string& bytes) {
  // An EXR attribute: its name, its type and its length of 4 bytes, the lowest first.
  std::string mark = kChecksumAttribute;
  mark += std::string_view("\0string\0\x10\0\0\0", 12);
  const std::string_view head = std::string_view(bytes).substr(0, kMaxHeaderBytes);
  const size_t at = head.find(mark);
  if (at == std::string::npos || at + mark.size() + kChecksumDigits > bytes.size()) {
    return std::nullopt;
  }
  return at + mark.size();
}

std::string checksum(std::string* bytes, size_t digits) {
  const std::string kept = bytes->substr(digits, kChecksumDigits);
  bytes->replace(digits, kChecksumDigits, kChecksumDigits, '0');
  const unsigned long long hash = OIIO::xxhash::XXH64(bytes->data(), bytes->size(), 0);
  bytes->replace(digits, kChecksumDigits, kept);
  std::array<char, kChecksumDigits + 1> text = {};
  std::snprintf(text.data(), text.size(), "%016llx", hash);
  return text.data();
}

}  // namespace alpenglow::io
