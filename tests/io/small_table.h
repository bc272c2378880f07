// Table files for tests: random finite texels in tables of any size.
#pragma once

#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/table_file.h>

#include <cstring>
#include <random>

namespace alpenglow::test {

/// Fills with halves (or the halves of floats) whose exponents are small, so nothing is NaN.
inline void fillTexels(std::vector<uint8_t>* texels, std::mt19937* random) {
  for (uint8_t& byte : *texels) byte = static_cast<uint8_t>((*random)() & 0x3F);
}

inline bool isOptionallyFloat(const std::string& name) {
  return name == "optical_depth" || name.rfind("moments", 0) == 0;
}

/// With random texels; with `orders` also the parts of each, of three for a description of all.
inline io::TableFile makeTables(const TableDesc& desc, bool orders) {
  io::TableFile file;
  findPreset("earth", &file.parameters, {});
  file.desc = desc;
  std::mt19937 random(1);
  const auto add = [&](const std::string& name, const io::TablePart& shape) {
    io::TablePart part = shape;
    part.name = name;
    if (isOptionallyFloat(name)) part.format = TableFormat::Float;
    const size_t texel = part.format == TableFormat::Half ? 8 : 16;
    part.texels.resize(size_t{part.width} * part.height * part.depth * texel);
    fillTexels(&part.texels, &random);
    file.parts.push_back(part);
  };
  const std::vector<io::TablePart> expected = io::expectedParts(desc);
  for (const io::TablePart& part : expected) add(part.name, part);
  const uint32_t count = desc.orders == 0 ? 3 : desc.orders;
  for (uint32_t order = 1; orders && order <= count; ++order) {
    const std::string suffix = "_order_" + std::to_string(order);
    if (desc.solver == Solver::Moments) {
      if (order > 1) add("source" + suffix, expected[2]);
      io::TablePart nodes = expected[1];
      nodes.width = desc.sizes.nodesMuS;
      nodes.height = 5 * desc.sizes.nodesR;
      if (order < count) add("moments" + suffix, nodes);
      continue;
    }
    add("scattering" + suffix, expected[2]);
    if (order == 1) add("single_mie" + suffix, expected[2]);
    add("irradiance" + suffix, expected[1]);
  }
  return file;
}

inline TableDesc smallStandard() {
  TableDesc desc;
  desc.solver = Solver::Standard;
  desc.orders = 2;
  desc.sizes = {.transmittanceMu = 4,
                .transmittanceR = 3,
                .irradianceMuS = 5,
                .irradianceR = 2,
                .scatteringR = 2,
                .scatteringMu = 4,
                .scatteringMuS = 3,
                .scatteringNu = 2};
  return desc;
}

inline TableDesc smallMoments() {
  TableDesc desc;
  desc.quality = Quality::Low;
  desc.sizes = {4, 3, 2, 3, 4, 2, 3, 5, 4, 3, 2, 2, 2};
  return desc;
}

/// A small description of each solver.
inline std::vector<TableDesc> smallDescs() { return {smallStandard(), smallMoments()}; }

}  // namespace alpenglow::test
