#include "atmosphere/cost/configurations.h"

#include <numbers>

namespace alpenglow::cost {
namespace {

struct Level {
  const char* name;
  Quality quality;
};
constexpr Level kLevels[] = {{"draft", Quality::Draft},
                             {"low", Quality::Low},
                             {"medium", Quality::Medium},
                             {"high", Quality::High},
                             {"ultra", Quality::Ultra}};

TableDesc moments(Quality quality = Quality::Medium) {
  TableDesc desc;
  desc.quality = quality;
  return desc;
}

TableDesc ofSolver(Solver solver, uint32_t stepCount = 0) {
  TableDesc desc;
  desc.solver = solver;
  desc.sizes.stepCount = stepCount;
  return desc;
}

/// Of the paper's.
TableSizes standardSizes(double factor) {
  TableSizes sizes;
  const auto scaled = [factor](uint32_t size) {
    return static_cast<uint32_t>(factor * size / 4.0 + 0.5) * 4;
  };
  sizes.scatteringR = scaled(32);
  sizes.scatteringMu = scaled(128);
  sizes.scatteringMuS = scaled(32);
  return sizes;
}

class List {
 public:
  explicit List(bool quick) : quick_(quick) {}

  Configuration& add(const std::string& sweep, const std::string& name, const std::string& family,
                     const TableDesc& desc, const std::string& detail) {
    Configuration c;
    c.sweep = sweep;
    c.name = name;
    c.family = family;
    c.detail = detail;
    c.desc = desc;
    return list_.emplace_back(c);
  }

  void addModels() {
    add("model", "moments", "moments", moments(), "all orders, level medium, from a sky-view LUT");
    add("model", "standard", "standard", ofSolver(Solver::Standard),
        "5 orders, the paper's table sizes, from a sky-view LUT");
    TableDesc single = moments();
    single.orders = 1;
    single.disabledEffects = effectBit(Effect::MultipleScattering);
    add("model", "single (moments)", "single", single, "one order, from a sky-view LUT");
    if (!quick_) {
      TableDesc one = ofSolver(Solver::Standard);
      one.orders = 1;
      add("model", "single (standard)", "single", one, "one order, from a sky-view LUT");
    }
    add("model", "hoffman-preetham", "hoffman-preetham", ofSolver(Solver::HoffmanPreetham),
        "2002, in closed form; undefined below the horizon")
        .fromLut = false;
    for (const uint32_t stepCount :
         quick_ ? std::vector<uint32_t>{10, 30} : std::vector<uint32_t>{5, 10, 20, 50})
      add("model", "oneil " + std::to_string(stepCount), "oneil",
          ofSolver(Solver::ONeil, stepCount),
          "2005, one order, " + std::to_string(stepCount) + " samples a ray")
          .fromLut = false;
    add("model", "schafhitzel", "schafhitzel", ofSolver(Solver::Schafhitzel),
        "2007, one order, a table without the azimuth")
        .fromLut = false;
    for (const uint32_t stepCount :
         quick_ ? std::vector<uint32_t>{32} : std::vector<uint32_t>{16, 32, 64})
      add("model", "hillaire " + std::to_string(stepCount), "hillaire",
          ofSolver(Solver::Hillaire, stepCount),
          "2020, sky-view table of " + std::to_string(stepCount) + " samples a ray");
  }

  void addLevels() {
    for (const Level& level : kLevels) {
      if (quick_ && level.quality > Quality::Medium) break;
      add("quality", level.name, "moments", moments(level.quality),
          "all orders, from a sky-view LUT");
      Configuration& lean =
          add("quality", std::string(level.name) + ", planned", "moments", moments(level.quality),
              "all orders, from a sky-view LUT, a camera that stays in the atmosphere");
      lean.viewDisabledEffects = effectBit(Effect::SpaceViews) | effectBit(Effect::SunDisc);
    }
  }

  void addOrders() {
    for (uint32_t orders = 1; orders <= 5; ++orders) {
      if (quick_ && orders % 2 == 0) continue;
      TableDesc desc = moments();
      desc.orders = orders;
      add("orders", "moments " + std::to_string(orders), "moments", desc, "no tail");
      if (quick_) continue;
      desc = ofSolver(Solver::Standard);
      desc.orders = orders;
      desc.sizes = standardSizes(0.5);
      add("orders", "standard " + std::to_string(orders), "standard", desc, "half the sizes");
    }
    add("orders", "moments all", "moments", moments(), "5 solved, then a geometric tail");
  }

  void addSizes() {
    for (const double factor : quick_ ? std::vector<double>{0.5} : std::vector<double>{0.25, 0.5}) {
      TableDesc desc = ofSolver(Solver::Standard);
      desc.sizes = standardSizes(factor);
      add("sizes", factor == 0.5 ? "standard, half" : "standard, a quarter", "standard", desc,
          "of r, mu and mu_s");
    }
    struct Setting {
      const char* name;
      uint32_t TableSizes::*field;
      uint32_t value;
    };
    constexpr Setting kSettings[] = {{"26 sun nodes (52)", &TableSizes::nodesMuS, 26},
                                     {"8 altitudes (15)", &TableSizes::nodesR, 8},
                                     {"degree 8 (14)", &TableSizes::degree, 8},
                                     {"20 angles (40)", &TableSizes::sourceGamma, 20},
                                     {"12 azimuths (24)", &TableSizes::sourcePsi, 12},
                                     {"depths of 64 (256)", &TableSizes::depthMu, 64}};
    for (const Setting& setting : kSettings) {
      if (quick_) break;
      TableDesc desc = moments();
      desc.sizes.*setting.field = setting.value;
      add("sizes", std::string("moments, ") + setting.name, "moments", desc,
          "one setting of level medium changed");
    }
  }

  void addSamples() {
    for (const uint32_t panels :
         quick_ ? std::vector<uint32_t>{3} : std::vector<uint32_t>{2, 3, 4, 9}) {
      TableDesc desc = moments();
      desc.sizes.viewPanels = panels;
      add("samples", "moments, " + std::to_string(2 * panels) + " a piece", "moments", desc,
          "points on each smooth segment of a ray (12)");
    }
  }

  void addStorage() {
    TableDesc desc = moments();
    desc.format = TableFormat::Float;
    add("storage", "moments, float", "moments", desc, "sources in 32-bit floats");
    add("storage", "moments, half", "moments", moments(), "sources in half floats");
    add("storage", "moments, shared exponent", "moments", moments(),
        "sources rounded to RGB9E5: what it would cost in accuracy; not a storage format, since "
        "drivers can't write it")
        .storage = Storage::SharedExponent;
    if (quick_) return;
    desc = ofSolver(Solver::Standard);
    desc.sizes = standardSizes(0.5);
    add("storage", "standard, six values", "standard", desc, "half sizes, half floats");
    desc.mie = MieStorage::Packed;
    add("storage", "standard, four values", "standard", desc, "half sizes, half floats");
    desc.mie = MieStorage::Full;
    desc.format = TableFormat::Float;
    add("storage", "standard, float", "standard", desc, "half sizes");
  }

  void addLookups() {
    add("lookups", "moments, full lookups", "moments", moments(), "each pixel's ray integrated")
        .fromLut = false;
    if (quick_) return;
    add("lookups", "moments draft, full lookups", "moments", moments(Quality::Draft),
        "each pixel's ray integrated")
        .fromLut = false;
    TableDesc desc = ofSolver(Solver::Standard);
    desc.sizes = standardSizes(0.5);
    add("lookups", "standard, full lookups", "standard", desc, "half the sizes").fromLut = false;
  }

  void addDomains() {
    constexpr double kSun = 3.0;
    const double zenith = (90.0 - kSun) * std::numbers::pi / 180.0;
    const auto under = [&](const char* name, const TableDesc& desc, const char* detail) {
      add("domain", name, "moments", desc, detail).onlySun_deg = kSun;
    };
    under("every sun", moments(), "seen from the ground under a sun 3 degrees high");
    TableDesc one = moments();
    one.sunZenithFrom = one.sunZenithTo = zenith;
    one.sizes.depthMu = 128;
    one.sizes.depthH = 64;
    under("one evening sun", one, "tables for that sun alone");
    one.quality = Quality::High;
    one.sizes = {};
    if (!quick_) under("one evening sun, high", one, "as large as those of every sun");
    TableDesc day = moments();
    day.sunZenithFrom = 0.01;
    day.sunZenithTo = 80.0 * std::numbers::pi / 180.0;
    add("domain", "day alone", "moments", day, "sun elevations above 10 degrees").bands = 1;
  }

  std::vector<Configuration> take() { return std::move(list_); }

 private:
  bool quick_;
  std::vector<Configuration> list_;
};

}  // namespace

std::vector<Configuration> configurations(bool quick) {
  List list(quick);
  list.addModels();
  list.addLevels();
  list.addOrders();
  list.addSizes();
  list.addSamples();
  list.addStorage();
  list.addLookups();
  list.addDomains();
  return list.take();
}

}  // namespace alpenglow::cost
