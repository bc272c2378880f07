#include <alpenglow/cost.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace alpenglow::cost {

Timing timingOf(std::vector<double> values) {
  Timing timing;
  if (values.empty()) return timing;
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  timing.median = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  timing.least = values.front();
  timing.most = values.back();
  timing.runs = static_cast<uint32_t>(values.size());
  return timing;
}

std::vector<size_t> paretoFront(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<size_t> order(x.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::erase_if(order, [&](size_t i) { return !(x[i] > 0.0 && y[i] > 0.0); });
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return x[a] != x[b] ? x[a] < x[b] : y[a] < y[b]; });
  std::vector<size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const size_t i : order) {
    if (y[i] >= least) continue;
    least = y[i];
    front.push_back(i);
  }
  return front;
}

double Row::groundFrame_ms() const {
  double sum = 0.0;
  for (uint32_t i = 0; i < kGroundViews; ++i) {
    if (frame_ms[i].runs == 0) return 0.0;
    sum += frame_ms[i].median;
  }
  return sum / kGroundViews;
}

}  // namespace alpenglow::cost
