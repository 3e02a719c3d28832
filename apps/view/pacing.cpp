#include "apps/view/pacing.h"

#include <algorithm>
#include <cmath>

namespace tetraglass::apps::view {

void Pacing::changed(double now_ms) {
  changed_ms_ = now_ms;
  drawn_.reset();
}

std::optional<int> Pacing::next(double now_ms) const {
  if (drawing_) return std::nullopt;
  if (!drawn_) return coarseness_;
  if (*drawn_ > 1 && now_ms - changed_ms_ >= kRestMs) return 1;
  return std::nullopt;
}

void Pacing::started(int coarseness) {
  refining_ = coarseness == 1 && drawn_ && *drawn_ > 1;
  drawing_ = coarseness;
  drawn_ = coarseness;
}

void Pacing::finished(double ms) {
  const int drawn = drawing_.value_or(1);
  drawing_.reset();
  // Time goes with the number of pixels at worst: a coarseness that this predicts to be in time is.
  const double pixels = 1.0 / (drawn * drawn);
  int fits = 1;
  while (fits < kCoarsest && ms / pixels / (fits * fits) > kMovingMs) ++fits;
  // What does not depend on the number of pixels may take most of the time: one step finer only,
  // and only from what was in time.
  if (fits < coarseness_) fits = coarseness_ - 1;
  coarseness_ = fits;
}

void Pacing::interrupted() {
  drawing_.reset();
  drawn_.reset();
}

void Pacing::failed() {
  drawing_.reset();
  if (drawn_) drawn_ = 1;
}

std::optional<double> Pacing::wait_ms(double now_ms) const {
  if (drawing_ || !drawn_ || *drawn_ == 1) return std::nullopt;
  return std::max(0.0, kRestMs - (now_ms - changed_ms_));
}

}  // namespace tetraglass::apps::view
