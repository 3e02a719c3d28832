#include "preint/psi_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/parallel.h"

namespace tetraglass::preint {

double psi(double k_front, double k_back) {
  if (!std::isfinite(k_front) || !std::isfinite(k_back)) return 0;
  // Of a color that is 1 at the front and 0 at the back, 1 - Psi arrives.
  const TransferFunction tf({{0, Color::Ones(), k_front}, {1, Color::Zero(), k_back}});
  return std::max(0.0, 1 - integrate_full(tf, {0, 1, 1}).color[0]);
}

PsiTable psi_table(int n) {
  if (n < 2) throw base::UsageError(fmt::format("a table needs at least 2 values, not {}", n));
  const auto size = static_cast<std::size_t>(n);
  PsiTable table{n, std::vector<float>(size * size)};
  const auto k = [&](std::size_t i) {
    const double gamma = static_cast<double>(i) / (n - 1);
    return gamma / (1 - gamma);  // infinite at the end
  };
  base::parallel_ranges(size, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t back = begin; back < end; ++back) {
      for (std::size_t front = 0; front < size; ++front) {
        table.psi[back * size + front] = static_cast<float>(psi(k(front), k(back)));
      }
    }
  });
  return table;
}

double PsiTable::lookup(double k_front, double k_back) const {
  const auto size = static_cast<std::size_t>(n);
  const double f = psi_gamma(k_front) * (n - 1);
  const double b = psi_gamma(k_back) * (n - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(f), size - 2);
  const std::size_t j = std::min(static_cast<std::size_t>(b), size - 2);
  const double x = f - static_cast<double>(i);
  const double y = b - static_cast<double>(j);
  const float* at = &psi[j * size + i];
  return (1 - y) * ((1 - x) * at[0] + x * at[1]) + y * ((1 - x) * at[size] + x * at[size + 1]);
}

}  // namespace tetraglass::preint
