// SPDX-License-Identifier: MIT
// How far a film is from the picture it converges to, told from its own samples: docs/sampling.md.
#pragma once

#include "tracer/render/film.h"

namespace tracer {

/// Added to a channel's square before a squared error is divided by it.
inline constexpr double relmse_epsilon = 0.01;

/// An estimate of the mean over pixels and channels of (x - r)^2 / (r^2 + relmse_epsilon), x the
/// film's mean and r what it converges to.
struct FilmError {
  double relmse = 0;
  double standard_error = 0;

  /// What the error is at or under in 19 of 20 pictures.
  double upper_bound() const;
};

/// That of one pixel: an estimate for independent samples, too large for samples that keep apart.
/// Infinite below 2 samples. Pixels that share no corner or edge with it, or only an edge, have no
/// part in it.
double pixel_error(const Film& film, int x, int y);

/// Infinite where a pixel has fewer than 2 samples. Takes all threads.
FilmError estimate_error(const Film& film);

}  // namespace tracer
