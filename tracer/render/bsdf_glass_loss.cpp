// SPDX-License-Identifier: MIT
#include "tracer/render/bsdf_glass_loss.h"

#include "tracer/render/bsdf_fresnel.h"
#include "tracer/render/bsdf_tables.h"

namespace tracer {
namespace {

constexpr double pi = std::numbers::pi;

// Between 1.1 and 3, by the root of the reflectance head-on.
constexpr double least_root = 0.1 / 2.1;
constexpr double largest_root = 0.5;
double place_of_ior(double ior) {
  return ((ior - 1) / (ior + 1) - least_root) / (largest_root - least_root);
}
double ior_of_place(double place) {
  const double root = least_root + place * (largest_root - least_root);
  return (1 + root) / (1 - root);
}

double lambda(double alpha, double cosine) {
  const double square = (1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + alpha * alpha * std::max(0.0, square)) - 1) / 2;
}

/// Light towards w, in the plane of x and z, by way of a facet.
struct ByFacet {
  double alpha;
  double eta;
  Vec3d w;
  double own_lambda = lambda(alpha, w.z);

  /// What the facet reflects and transmits of all that could come by way of it.
  double passed(const Vec3d& h) const {
    const double cosine = glm::dot(w, h);
    const double reflected = fresnel_dielectric(cosine, eta);
    double sum = 0;
    const double up = 2 * cosine * h.z - w.z;
    if (up > 0) sum += reflected / (1 + own_lambda + lambda(alpha, up));
    const double squared = 1 - (1 - cosine * cosine) / (eta * eta);
    if (squared <= 0) return sum;
    const double down = w.z / eta - (cosine / eta - std::sqrt(squared)) * h.z;
    if (down > 0) sum += (1 - reflected) / ((1 + own_lambda) * (1 + lambda(alpha, down)));
    return sum;
  }
};

/// Over slopes (r cos, r sin), r = alpha tan psi, of facets that face w.
double integrate_loss(double cosine, double alpha, double eta) {
  static const auto turns_nodes = make_gauss_nodes<12>();
  static const auto psi_nodes = make_gauss_nodes<24>();
  const double sine = std::sqrt(1 - cosine * cosine);
  const ByFacet by_facet{alpha, eta, {sine, 0, cosine}};
  double sum = 0;
  const auto add_line = [&](double turns, double weight) {
    const CosSin around = cos_sin_of_turns(turns);
    const double end = around.cos < 0 ? angle_of(-alpha * around.cos * sine, cosine) : pi / 2;
    for (const QuadratureNode& node : psi_nodes) {
      const CosSin facet = cos_sin_of_turns(end * node.place / (2 * pi));
      const double slope = alpha * facet.sin / facet.cos;
      const Vec3d h = glm::normalize(Vec3d(slope * around.cos, slope * around.sin, 1));
      const double towards = cosine + slope * around.cos * sine;
      sum += weight * node.weight * end * 2 * facet.sin * facet.cos * towards / cosine *
             by_facet.passed(h);
    }
  };
  for (const QuadratureNode& node : turns_nodes) {
    add_line(node.place / 4, node.weight / 2);
    add_line(0.25 + node.place / 4, node.weight / 2);
  }
  return 1 - sum;
}

double between(double low, double high, double weight) {
  return low + weight * (high - low);
}

}  // namespace

GlassLossTables::GlassLossTables() {
  fill(Side::outside);
  fill(Side::inside);
}

// Integrated at few places; from there, axis by axis, at all.
void GlassLossTables::fill(Side side) {
  static const auto iors = make_chebyshev_places<6>();
  static const auto alphas = make_chebyshev_places<12>();
  static const auto cosines = make_chebyshev_places<14>();
  constexpr size_t row = cosine_count;
  std::vector<double> few;  // [few iors][few alphas][all cosines]
  for (const double ior_place : iors) {
    const double ior = ior_of_place(ior_place);
    for (const double alpha_place : alphas) {
      const double alpha = alpha_of_place(alpha_place);
      std::array<double, cosines.size()> known;
      for (size_t k = 0; k < cosines.size(); ++k) {
        const double cosine = std::max(0x1p-20, cosine_of_place(cosines[k], alpha));
        known[k] = integrate_loss(cosine, alpha, side == Side::outside ? ior : 1 / ior);
      }
      for (size_t i = 0; i < row; ++i) {
        const auto weights = chebyshev_weights(cosines, place_of(i, row));
        double sum = 0;
        for (size_t k = 0; k < known.size(); ++k) sum += weights[k] * known[k];
        few.push_back(sum);
      }
    }
  }
  auto& losses = losses_[static_cast<size_t>(side)];
  for (size_t n = 0; n < ior_count * alpha_count; ++n) {
    const auto ior_weights = chebyshev_weights(iors, place_of(n / alpha_count, ior_count));
    const auto alpha_weights = chebyshev_weights(alphas, place_of(n % alpha_count, alpha_count));
    std::array<double, row> sums{};
    for (size_t k = 0; k < iors.size() * alphas.size(); ++k) {
      const double weight = ior_weights[k / alphas.size()] * alpha_weights[k % alphas.size()];
      for (size_t i = 0; i < row; ++i) sums[i] += weight * few[k * row + i];
    }
    for (const double sum : sums)
      losses.push_back(static_cast<float>(std::clamp(sum, 0x1p-20, 1.0)));
  }
  static const auto nodes = make_gauss_nodes<32>();
  auto& means = means_[static_cast<size_t>(side)];
  for (size_t n = 0; n < ior_count * alpha_count; ++n) {
    const double alpha = alpha_of_place(place_of(n % alpha_count, alpha_count));
    const Place here{alpha, n % alpha_count, 0, n / alpha_count, 0};
    double mean = 0;
    for (const QuadratureNode& node : nodes) {
      const double cosine = node.place * node.place;
      mean += node.weight * 4 * node.place * cosine * loss(here, side, cosine);
    }
    means.push_back(static_cast<float>(mean));
  }
}

auto GlassLossTables::place(double alpha, double ior) -> Place {
  const LinearTaps alphas = make_linear_taps(place_of_alpha(alpha), alpha_count);
  const LinearTaps iors = make_linear_taps(place_of_ior(ior), ior_count);
  return {alpha, alphas.first, alphas.next_weight, iors.first, iors.next_weight};
}

double GlassLossTables::loss(const Place& place, Side side, double cosine) const {
  const LinearTaps taps = make_linear_taps(place_of_cosine(cosine, place.alpha), cosine_count);
  const auto row_at = [&](size_t ior, size_t alpha) {
    const size_t n = std::min(ior, ior_count - 1) * alpha_count + std::min(alpha, alpha_count - 1);
    const float* row = &losses_[static_cast<size_t>(side)][n * cosine_count + taps.first];
    return between(row[0], row[1], taps.next_weight);
  };
  const auto at_ior = [&](size_t ior) {
    return between(row_at(ior, place.first_alpha), row_at(ior, place.first_alpha + 1),
                   place.next_alpha);
  };
  return between(at_ior(place.first_ior), at_ior(place.first_ior + 1), place.next_ior);
}

double GlassLossTables::mean_loss(const Place& place, Side side) const {
  const float* means =
      &means_[static_cast<size_t>(side)][place.first_ior * alpha_count + place.first_alpha];
  return between(between(means[0], means[1], place.next_alpha),
                 between(means[alpha_count], means[alpha_count + 1], place.next_alpha),
                 place.next_ior);
}

const GlassLossTables& glass_loss_tables() {
  static const GlassLossTables tables;
  return tables;
}

}  // namespace tracer
