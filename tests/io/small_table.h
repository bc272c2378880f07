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

inline io::TableFile makeTables(const TableDesc& desc, bool orders) {
  io::TableFile file;
  findPreset("earth", &file.parameters);
  file.desc = desc;
  std::mt19937 random(1);
  const auto add = [&](const std::string& name, const io::TablePart& shape) {
    io::TablePart part = shape;
    part.name = name;
    if (name == "optical_depth") part.format = TableFormat::Float;
    const size_t texel = part.format == TableFormat::Half ? 8 : 16;
    part.texels.resize(size_t{part.width} * part.height * part.depth * texel);
    fillTexels(&part.texels, &random);
    file.parts.push_back(part);
  };
  const std::vector<io::TablePart> expected = io::expectedParts(desc);
  for (const io::TablePart& part : expected) add(part.name, part);
  for (uint32_t order = 1; orders && order <= desc.orders; ++order) {
    const std::string suffix = "_order_" + std::to_string(order);
    add("scattering" + suffix, expected[2]);
    if (order == 1) add("single_mie" + suffix, expected[2]);
    add("irradiance" + suffix, expected[1]);
  }
  return file;
}

inline TableDesc smallDesc() {
  TableDesc desc;
  desc.orders = 2;
  desc.sizes = {4, 3, 5, 2, 2, 4, 3, 2};
  return desc;
}

}  // namespace alpenglow::test
