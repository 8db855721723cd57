#include "score/fit.h"

#include <algorithm>
#include <cmath>

#include "base/golden_section.h"

namespace gloam::score {
namespace {

/// The exponents that are tried, as powers of e; beyond, a method differs by more than its exponent.
const double least_exponent = std::log(0.1), most_exponent = std::log(10.0);

}  // namespace

void FitSums::add(const bench::Image& image, const bench::Image& truth, const bench::Foreground& foreground) {
  for (const auto& [view, mask] : foreground) {
    const auto tested = image.find(view), expected = truth.find(view);
    if (tested == image.end() || expected == truth.end()) continue;
    const std::vector<Channel>&a = tested->second.channels, &b = expected->second.channels;
    const Layout& layout = a[0].layout();
    for (size_t c = 0; c < std::min(a.size(), b.size()); ++c) {
      for (int y = 0; y < layout.height; ++y) {
        for (int x = 0; x < layout.width; ++x) {
          if (!mask[size_t(y) * size_t(layout.width) + size_t(x)]) continue;
          const double value = a[c].at(x, y), t = b[c].at(x, y);
          count_ += 1;
          value_ += value;
          truth_ += t;
          value_squared_ += value * value;
          truth_squared_ += t * t;
          product_ += value * t;
          if (!is_of_shares_) continue;
          Bin& bin = bins_[size_t(std::lround(std::clamp(value, 0.0, 1.0) * double(bin_count - 1)))];
          bin.count += 1;
          bin.value += std::clamp(value, 0.0, 1.0);
          bin.truth += t;
        }
      }
    }
  }
}

FitSums& FitSums::operator+=(const FitSums& other) {
  for (size_t i = 0; i < bins_.size(); ++i) {
    bins_[i].count += other.bins_[i].count;
    bins_[i].value += other.bins_[i].value;
    bins_[i].truth += other.bins_[i].truth;
  }
  count_ += other.count_;
  value_ += other.value_;
  truth_ += other.truth_;
  value_squared_ += other.value_squared_;
  truth_squared_ += other.truth_squared_;
  product_ += other.product_;
  return *this;
}

/// With u = 1 - image^exponent and v = 1 - truth, the strength that makes sum (strength u - v)^2 least is sum uv / sum uu.
FitSums::Squares FitSums::squares_of(double exponent) const {
  double uu = 0, uv = 0;
  for (const Bin& bin : bins_) {
    if (bin.count == 0) continue;
    const double u = 1 - std::pow(bin.value / bin.count, exponent);
    uu += bin.count * u * u;
    uv += u * (bin.count - bin.truth);
  }
  const double strength = uu > 0 ? std::max(uv / uu, 0.0) : 0;
  const double vv = count_ - 2 * truth_ + truth_squared_;
  return {vv - 2 * strength * uv + strength * strength * uu, strength};
}

std::optional<BestFit> FitSums::best() const {
  if (count_ == 0) return {};
  BestFit best;
  if (!is_of_shares_) {
    if (value_squared_ <= 0) return {};
    best.scale = std::max(product_ / value_squared_, 0.0);
    const double error = truth_squared_ - 2 * best.scale * product_ + best.scale * best.scale * value_squared_;
    best.rmse = std::sqrt(std::max(error, 0.0) / count_);
    return best;
  }
  const auto error_at = [&](double power) { return squares_of(std::exp(power)).error; };
  // The nearest of some powers, then between its neighbours by the golden section.
  constexpr int tries = 41;
  const double step = (most_exponent - least_exponent) / (tries - 1);
  double nearest = least_exponent;
  for (int i = 1; i < tries; ++i) {
    if (error_at(least_exponent + i * step) < error_at(nearest)) nearest = least_exponent + i * step;
  }
  best.exponent = std::exp(least_between(nearest - step, nearest + step, 40, error_at));
  const Squares squares = squares_of(best.exponent);
  if (squares.strength == 0) return {};
  best.strength = squares.strength;
  best.rmse = std::sqrt(std::max(squares.error, 0.0) / count_);
  return best;
}

std::optional<double> FitSums::correlation() const {
  if (count_ == 0) return {};
  const double value = value_squared_ / count_ - value_ * value_ / count_ / count_,
               truth = truth_squared_ / count_ - truth_ * truth_ / count_ / count_;
  if (!(value > 1e-12) || !(truth > 1e-12)) return {};
  return (product_ / count_ - value_ * truth_ / count_ / count_) / std::sqrt(value * truth);
}

double FitSums::rmse() const {
  return count_ == 0 ? 0 : std::sqrt(std::max(value_squared_ - 2 * product_ + truth_squared_, 0.0) / count_);
}

bench::Image fitted(const bench::Image& image, const BestFit& fit, bool is_of_shares) {
  bench::Image out;
  for (const auto& [view, plane] : image) {
    Plane& made = out.emplace(view, plane.clone()).first->second;
    for (Channel& channel : made.channels) {
      const Layout& layout = channel.layout();
      for (int y = 0; y < layout.height; ++y) {
        for (int x = 0; x < layout.width; ++x) {
          const double value = channel.at(x, y);
          if (!std::isfinite(value)) continue;
          channel.at(x, y) =
              is_of_shares
                  ? float(std::clamp(1 - fit.strength * (1 - std::pow(std::max(value, 0.0), fit.exponent)), 0.0, 1.0))
                  : float(fit.scale * value);
        }
      }
    }
  }
  return out;
}

}  // namespace gloam::score
