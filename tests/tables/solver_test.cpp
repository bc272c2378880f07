// Every table of the bake against the solver's own text in double, fed with the device's tables of
// the step before: what remains is the device's float arithmetic and the storage format.
#include <cmath>
#include <cstdio>

#include "tests/tables/cpu_solver.h"

namespace alpenglow::testing {
namespace {

namespace cpu = solver_f64;

struct Errors {
  std::vector<double> relative;
  double largest = 0.0;

  // Relative to the value, but not below `floor`: a share of the table's largest value.
  void add(const cpu::Spectrum& expected, const float* actual, double floor) {
    for (int c = 0; c < 3; ++c) {
      const double e = std::abs(actual[c] - expected[c]) / std::max(expected[c], floor);
      relative.push_back(e);
      largest = std::max(largest, e);
    }
  }
};

double largestValue(const CpuTable& table) {
  float most = 0.0f;
  for (float v : table.values) most = std::max(most, v);
  return most;
}

void expectSmall(const char* what, const Errors& errors, double p95, double most) {
  std::printf("%-22s p50 %.2e  p95 %.2e  max %.2e of %zu values\n", what,
              percentile(errors.relative, 0.5), percentile(errors.relative, 0.95), errors.largest,
              errors.relative.size());
  EXPECT_LT(percentile(errors.relative, 0.95), p95) << what;
  EXPECT_LT(errors.largest, most) << what;
}

class SolverTest : public BakeTest {
 protected:
  void SetUp() override {
    BakeTest::SetUp();
    medium_ = makeMediumF64(preset("earth"));
    shape_ = cpu::shapeOf(kSmallSizes);
  }

  template <class Function>
  void forScattering(Function&& function) const {
    for (uint32_t z = 0; z < kSmallSizes.scatteringR; ++z)
      for (uint32_t y = 0; y < kSmallSizes.scatteringMu; ++y)
        for (uint32_t x = 0; x < kSmallSizes.scatteringMuS * kSmallSizes.scatteringNu; ++x)
          function(x, y, z, cpu::texelOf(medium_, shape_, x, y, z));
  }

  void checkOpticalDepth(const CpuTable& table) const {
    Errors errors;
    for (uint32_t y = 0; y < table.info.extent.height; ++y)
      for (uint32_t x = 0; x < table.info.extent.width; ++x) {
        const cpu::Real2 hMu = transmittanceHMu(medium_, {cpu::texelToU(x, shape_.transmittanceMu),
                                                          cpu::texelToU(y, shape_.transmittanceR)});
        const float* texel = table.texel(x, y);
        const cpu::Spectrum depth =
            cpu::decodeOpticalDepth(cpu::Spectrum(texel[0], texel[1], texel[2]));
        const float actual[] = {float(depth[0]), float(depth[1]), float(depth[2])};
        errors.add(tabulatedOpticalDepth(medium_, shape_, hMu[0], hMu[1]), actual, 1e-4);
      }
    // The table holds a logarithm: the device's log, about 1e-6 of values near 14, counts 14 times.
    expectSmall("optical depth", errors, 5e-5, 1e-3);
  }

  void checkFirstOrder(const CpuTable& rayleigh, const CpuTable& mie) const {
    Errors errorsR, errorsM;
    const double floorR = 1e-5 * largestValue(rayleigh), floorM = 1e-5 * largestValue(mie);
    forScattering([&](uint32_t x, uint32_t y, uint32_t z, const cpu::Texel& t) {
      cpu::Spectrum r, m;
      singleScattering(medium_, shape_, t.h, t.mu, t.muS, t.nu, t.hitsGround, r, m);
      const cpu::Spectrum shorter = shorterRay(medium_, shape_, t.h, t.mu, t.hitsGround, t.reach);
      r *= shorter;
      m *= shorter;
      errorsR.add(r, rayleigh.texel(x, y, z), floorR);
      errorsM.add(m, mie.texel(x, y, z), floorM);
    });
    // A sharp terminator: where rounding moves a trapezoid's end over it, one of 50 samples goes.
    expectSmall("dS 1 Rayleigh", errorsR, 1e-3, 1.0);
    expectSmall("dS 1 Mie", errorsM, 1e-3, 1.0);
  }

  // dL and dJ are not read back: both are computed here, from dS and dE of the order before.
  void fillSources() const {
    cpu::Sources& s = cpu::sources;
    s.incident = cpu::Source(kSmallSizes.scatteringNu * cpu::kSphereTheta,
                             kSmallSizes.scatteringMuS * kSmallSizes.scatteringR, 1);
    s.incidentMie = s.incident;
    for (uint32_t y = 0; y < s.incident.height; ++y)
      for (uint32_t x = 0; x < s.incident.width; ++x) {
        const double h =
            scatteringH(medium_, cpu::texelToU(y / kSmallSizes.scatteringMuS, shape_.scatteringR));
        const double muS =
            cpu::scatteringMuS(cpu::texelToU(y % kSmallSizes.scatteringMuS, shape_.scatteringMuS));
        const double nu =
            2.0 * cpu::texelToU(x % kSmallSizes.scatteringNu, shape_.scatteringNu) - 1.0;
        cpu::Spectrum radiance, mie;
        incidentRadiance(medium_, shape_, h, muS, nu,
                         static_cast<int>(x / kSmallSizes.scatteringNu), radiance, mie);
        for (int c = 0; c < 3; ++c) {
          s.incident.at(x, y, 0)[c] = radiance[c];
          s.incidentMie.at(x, y, 0)[c] = mie[c];
        }
      }
    s.deltaSource = cpu::Source(kSmallSizes.scatteringMuS * kSmallSizes.scatteringNu,
                                kSmallSizes.scatteringMu, kSmallSizes.scatteringR);
    forScattering([&](uint32_t x, uint32_t y, uint32_t z, const cpu::Texel& t) {
      const cpu::Spectrum j = scatteringDensity(medium_, shape_, x % kSmallSizes.scatteringMuS, z,
                                                t.h, t.mu, t.muS, t.nu);
      for (int c = 0; c < 3; ++c) s.deltaSource.at(x, y, z)[c] = j[c];
    });
  }

  void checkNextOrder(const char* name, const CpuTable& scattering,
                      const CpuTable& irradiance) const {
    Errors errorsS, errorsE;
    const double floorS = 1e-5 * largestValue(scattering);
    forScattering([&](uint32_t x, uint32_t y, uint32_t z, const cpu::Texel& t) {
      errorsS.add(multipleScattering(medium_, shape_, t.h, t.mu, t.muS, t.nu, t.hitsGround) *
                      shorterRay(medium_, shape_, t.h, t.mu, t.hitsGround, t.reach),
                  scattering.texel(x, y, z), floorS);
    });
    for (uint32_t y = 0; y < irradiance.info.extent.height; ++y)
      for (uint32_t x = 0; x < irradiance.info.extent.width; ++x) {
        const cpu::Real2 hMuS = irradianceHMuS(medium_, {cpu::texelToU(x, shape_.irradianceMuS),
                                                         cpu::texelToU(y, shape_.irradianceR)});
        errorsE.add(diffuseIrradiance(medium_, shape_, hMuS[0], hMuS[1]), irradiance.texel(x, y),
                    1e-6);
      }
    expectSmall((std::string("dS ") + name).c_str(), errorsS, 1e-3, 0.02);
    expectSmall((std::string("dE ") + name).c_str(), errorsE, 1e-3, 0.02);
  }

  cpu::Medium medium_;
  cpu::TableShape shape_;
};

TEST_F(SolverTest, TablesMatchTheSourceInDouble) {
  TableDesc desc = standardDesc(kSmallSizes);
  desc.orders = 3;
  desc.format = TableFormat::Float;
  desc.keepOrders = true;
  Tables* tables = makeTables(preset("earth"), desc);
  bake(tables, 0, "dS 1");
  const CpuTable direct = read(tables, kTableOrderIrradiance);
  const CpuTable rayleigh = read(tables, kTableOrderScattering);
  const CpuTable mie = read(tables, kTableOrderSingleMie);
  bake(tables, 0, "dS 2");
  const CpuTable irradiance2 = read(tables, kTableOrderIrradiance);
  const CpuTable scattering2 = read(tables, kTableOrderScattering);
  bake(tables);
  const CpuTable irradiance3 = read(tables, kTableOrderIrradiance);
  const CpuTable scattering3 = read(tables, kTableOrderScattering);
  const CpuTable opticalDepth = read(tables, kTableOpticalDepth);
  ASSERT_FALSE(HasFailure());

  cpu::Sources& s = cpu::sources;
  checkOpticalDepth(opticalDepth);
  s.opticalDepth = cpu::Source(opticalDepth);
  checkFirstOrder(rayleigh, mie);

  s.deltaRadiance = cpu::Source(rayleigh);
  s.deltaMie = cpu::Source(mie);
  s.deltaIrradiance = cpu::Source(direct);
  s.firstOrder = true;
  fillSources();
  checkNextOrder("2", scattering2, irradiance2);

  s.deltaRadiance = cpu::Source(scattering2);
  s.deltaIrradiance = cpu::Source(irradiance2);
  s.firstOrder = false;
  fillSources();
  checkNextOrder("3", scattering3, irradiance3);
}

// The sums E and S are the orders' sums, and --orders N counts events as docs say.
TEST_F(SolverTest, TheSumsAreTheSumsOfTheOrders) {
  TableDesc desc = standardDesc(kSmallSizes);
  desc.orders = 3;
  desc.format = TableFormat::Float;
  desc.keepOrders = true;
  Tables* tables = makeTables(preset("earth"), desc);
  std::vector<CpuTable> orders, irradiances;
  for (const char* pass : {"dS 1", "dS 2", "dS 3"}) {
    bake(tables, 0, pass);
    orders.push_back(read(tables, kTableOrderScattering));
    irradiances.push_back(read(tables, kTableOrderIrradiance));
  }
  const CpuTable s = read(tables, kTableScattering);
  const CpuTable e = read(tables, kTableIrradiance);
  ASSERT_FALSE(HasFailure());
  forScattering([&](uint32_t x, uint32_t y, uint32_t z, const cpu::Texel& t) {
    const double phase = cpu::rayleighPhase(t.nu);
    for (int c = 0; c < 3; ++c) {
      const double sum = orders[0].texel(x, y, z)[c] + orders[1].texel(x, y, z)[c] / phase +
                         orders[2].texel(x, y, z)[c] / phase;
      // The device's nu, clamped in float to what mu and mu_s allow, is off by up to 1e-4.
      ASSERT_NEAR(s.texel(x, y, z)[c], sum, 2e-4 * sum + 1e-9);
    }
  });
  for (uint32_t y = 0; y < e.info.extent.height; ++y)
    for (uint32_t x = 0; x < e.info.extent.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double sum = irradiances[1].texel(x, y)[c] + irradiances[2].texel(x, y)[c];
        ASSERT_NEAR(e.texel(x, y)[c], sum, 1e-5 * sum + 1e-9);
      }
}

}  // namespace
}  // namespace alpenglow::testing
