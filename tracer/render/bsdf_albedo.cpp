// SPDX-License-Identifier: MIT
#include "tracer/render/bsdf_albedo.h"

#include "tracer/render/bsdf_tables.h"

namespace tracer {
namespace {

constexpr double pi = std::numbers::pi;

/// Integrates over slopes (r cos, r sin) of facets, whose density is uniform in the angle and in
/// sin^2 of psi, r = alpha tan psi. Facets reflect w above the horizon within a circle.
GgxAlbedo integrate_ggx(double cosine, double alpha) {
  static const auto nodes = make_gauss_nodes<14>();
  const double sine = std::sqrt(1 - cosine * cosine);
  const double tangent = sine / cosine;
  const auto lambda = [alpha](double squared_tangent) {
    return (std::sqrt(1 + alpha * alpha * std::max(0.0, squared_tangent)) - 1) / 2;
  };
  const double own_lambda = lambda(tangent * tangent);
  GgxAlbedo sum{0, 0};
  const auto add_line = [&](double turns, double weight) {
    const double along = cos_sin_of_turns(turns).cos;
    const double reach = std::sqrt(tangent * tangent * along * along + 1);
    const double end = along > 0 ? reach + tangent * along : 1 / (reach - tangent * along);
    const double end_psi = angle_of(alpha, end);
    for (const QuadratureNode& node : nodes) {
      const double psi = end_psi * (1 - node.place * node.place);
      const CosSin facet = cos_sin_of_turns(psi / (2 * pi));
      const double slope = alpha * facet.sin / facet.cos;
      const double squared_height = 1 / (1 + slope * slope);
      const double towards = cosine + slope * along * sine;
      const double out = 2 * towards * squared_height - cosine;
      if (!(out > 0)) continue;
      const double measure = 4 * facet.sin * facet.cos * end_psi * node.place * node.weight;
      const double share = weight * measure * towards / cosine /
                           (1 + own_lambda + lambda((1 - out * out) / (out * out)));
      sum.full += share;
      sum.grazing += share * schlick_weight(towards * std::sqrt(squared_height));
    }
  };
  for (const QuadratureNode& node : nodes) {
    add_line(node.place / 4, node.weight / 2);
    add_line(0.25 + node.place / 4, node.weight / 2);
  }
  return sum;
}

template <size_t count, class Values>
GgxAlbedo weighted_sum(const std::array<double, count>& weights, const Values& values) {
  GgxAlbedo sum{0, 0};
  for (size_t k = 0; k < count; ++k) {
    sum.full += weights[k] * values(k).full;
    sum.grazing += weights[k] * values(k).grazing;
  }
  return sum;
}

/// Over the half-vector's reflectance; the azimuth by its symmetry.
double integrate_sheen(double cosine) {
  static const auto nodes = make_gauss_nodes<32>();
  const double sine = std::sqrt(1 - cosine * cosine);
  double sum = 0;
  for (const QuadratureNode& height : nodes) {
    const double other_sine = std::sqrt(1 - height.place * height.place);
    for (const QuadratureNode& around : nodes) {
      const double between =
          cosine * height.place + sine * other_sine * cos_sin_of_turns(around.place / 2).cos;
      const double half_cosine = std::sqrt(std::max(0.0, (1 + between) / 2));
      sum += height.weight * around.weight * height.place * schlick_weight(half_cosine);
    }
  }
  return 2 * pi * sum;
}

/// Cosines and the weights of their cosine-weighted mean, dense towards 0.
std::array<QuadratureNode, 48> make_mean_nodes() {
  std::array<QuadratureNode, 48> nodes = make_gauss_nodes<48>();
  for (QuadratureNode& node : nodes) {
    const double x = node.place;
    node = {x * x * x, 2 * x * x * x * 3 * x * x * node.weight};
  }
  return nodes;
}

}  // namespace

AlbedoTables::AlbedoTables() {
  fill_ggx();
  fill_sheen();
  fill_means();
}

// Integrated at few places, from which smooth functions are known everywhere.
void AlbedoTables::fill_ggx() {
  static const auto cosines = make_chebyshev_places<32>();
  static const auto alphas = make_chebyshev_places<16>();
  std::vector<GgxAlbedo> rows;  // [few alphas][all cosines]
  for (const double alpha_place : alphas) {
    const double alpha = alpha_of_place(alpha_place);
    std::array<GgxAlbedo, cosines.size()> known;
    for (size_t k = 0; k < cosines.size(); ++k) {
      known[k] = integrate_ggx(std::max(0x1p-30, cosine_of_place(cosines[k], alpha)), alpha);
    }
    for (size_t i = 0; i < cosine_count; ++i) {
      rows.push_back(weighted_sum(chebyshev_weights(cosines, place_of(i, cosine_count)),
                                  [&](size_t k) { return known[k]; }));
    }
  }
  ggx_.reserve(alpha_count * cosine_count);
  for (size_t j = 0; j < alpha_count; ++j) {
    const auto weights = chebyshev_weights(alphas, place_of(j, alpha_count));
    for (size_t i = 0; i < cosine_count; ++i) {
      const GgxAlbedo albedo =
          weighted_sum(weights, [&](size_t k) { return rows[k * cosine_count + i]; });
      ggx_.emplace_back(albedo.full, albedo.grazing);
    }
  }
}

void AlbedoTables::fill_sheen() {
  for (size_t i = 0; i < sheen_count; ++i) {
    const double root = static_cast<double>(i) / (sheen_count - 1);
    sheen_.push_back(integrate_sheen(root * root));
  }
}

void AlbedoTables::fill_means() {
  const auto nodes = make_mean_nodes();
  for (size_t j = 0; j < alpha_count; ++j) {
    const double alpha = alpha_of_place(place_of(j, alpha_count));
    double loss = 0;
    for (const QuadratureNode& node : nodes)
      loss += node.weight * (1 - ggx(row(alpha), node.place).full);
    loss_.push_back(loss / (alpha * alpha));
  }
  std::vector<LayerWeights> shares;  // [alpha][node]
  for (size_t j = 0; j < mean_count; ++j) {
    const Row alpha_row = row(alpha_of_place(place_of(j, mean_count)));
    for (const QuadratureNode& node : nodes) {
      const GgxAlbedo albedo = ggx(alpha_row, node.place);
      shares.push_back({1, albedo.full, albedo.grazing});
    }
  }
  moments_.assign(mean_count * mean_count, Moments{});
  for (size_t pair = 0; pair < moments_.size(); ++pair) {
    for (size_t i = 0; i < nodes.size(); ++i) {
      const LayerWeights& coat = shares[pair / mean_count * nodes.size() + i];
      const LayerWeights& base = shares[pair % mean_count * nodes.size() + i];
      const double of_sheen[2] = {nodes[i].weight, nodes[i].weight * sheen(nodes[i].place)};
      for (size_t k = 0; k < 18; ++k) {
        moments_[pair][k] += of_sheen[k / 9] * coat[k / 3 % 3] * base[k % 3];
      }
    }
  }
}

AlbedoTables::Row AlbedoTables::row(double alpha) const {
  const LinearTaps taps = make_linear_taps(place_of_alpha(alpha), alpha_count);
  return {alpha, taps.first, taps.next_weight};
}

GgxAlbedo AlbedoTables::ggx(const Row& row, double cosine) const {
  const LinearTaps taps = make_linear_taps(place_of_cosine(cosine, row.alpha), cosine_count);
  const Vec2f* here = &ggx_[row.first * cosine_count + taps.first];
  const Vec2f* next = here + cosine_count;
  const Vec2d low = Vec2d(here[0]) + taps.next_weight * (Vec2d(here[1]) - Vec2d(here[0]));
  const Vec2d high = Vec2d(next[0]) + taps.next_weight * (Vec2d(next[1]) - Vec2d(next[0]));
  const Vec2d albedo = low + row.next_weight * (high - low);
  return {std::min(albedo.x, 1.0), std::clamp(albedo.y, 0.0, 1.0)};
}

double AlbedoTables::mean_loss(const Row& row) const {
  const double here = loss_[row.first];
  return row.alpha * row.alpha * (here + row.next_weight * (loss_[row.first + 1] - here));
}

double AlbedoTables::sheen(double cosine) const {
  const CubicTaps taps = make_cubic_taps(std::sqrt(cosine), sheen_count);
  double sum = 0;
  for (size_t i = 0; i < 4; ++i) sum += taps.weights[i] * sheen_[taps.first + i];
  return sum;
}

double AlbedoTables::mean_product(const LayerWeights& sheen, const LayerWeights& coat,
                                  const Row& coat_row, const LayerWeights& base,
                                  const Row& base_row) const {
  Moments weights;
  for (size_t k = 0; k < weights.size(); ++k) {
    weights[k] = sheen[k / 9] * coat[k / 3 % 3] * base[k % 3];
  }
  // A layer that hides nothing is the same at any alpha.
  const auto taps_of = [](const LayerWeights& layer, const Row& row) {
    if (layer[1] == 0 && layer[2] == 0) return CubicTaps{};
    return make_cubic_taps(place_of_alpha(row.alpha), mean_count);
  };
  const CubicTaps rows = taps_of(coat, coat_row);
  const CubicTaps columns = taps_of(base, base_row);
  double sum = 0;
  for (size_t j = 0; j < 4; ++j) {
    for (size_t i = 0; i < 4; ++i) {
      const double weight = rows.weights[j] * columns.weights[i];
      if (weight == 0) continue;
      const Moments& moments = moments_[(rows.first + j) * mean_count + columns.first + i];
      for (size_t k = 0; k < weights.size(); ++k) sum += weight * weights[k] * moments[k];
    }
  }
  return sum;
}

const AlbedoTables& albedo_tables() {
  static const AlbedoTables tables;
  return tables;
}

}  // namespace tracer
