// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "app/session.h"
#include "tests/support/test_ball.h"

namespace app {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A session with the part of the window: adopts models, keeps the picture that the tiles make.
class SessionTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("boxwood-session-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    edits_.size_px = {96, 64};
    edits_.sample_limit = 2;
  }
  void TearDown() override {
    session_.reset();
    std::filesystem::remove_all(folder_);
  }

  std::filesystem::path ball(const std::string& name, int rings) {
    const std::filesystem::path path = folder_ / name;
    tests::write_ball(path, rings);
    return path;
  }

  void poll() {
    const Update update = session_->poll();
    status_ = update.status;
    if (!update.tiles.empty() && picture_.size_px != update.size_px) {
      picture_ = {update.size_px, std::vector<tracer::Vec3f>(static_cast<size_t>(update.size_px.x) *
                                                             update.size_px.y)};
    }
    for (const FinishedTile& finished : update.tiles) place(finished);
    if (status_.model_generation != edits_.model_generation) {
      const tracer::Mesh& mesh = *status_.model->scene.mesh;
      edits_.camera = default_camera(mesh.bounds, mesh.origin, 1.5);
      edits_.model_generation = status_.model_generation;
      session_->set(edits_);
    }
  }

  void place(const FinishedTile& finished) {
    const tracer::Tile& tile = finished.tile;
    for (int y = 0; y < tile.height(); ++y) {
      for (int x = 0; x < tile.width(); ++x) {
        picture_.pixels[static_cast<size_t>(tile.y0 + y) * picture_.size_px.x + tile.x0 + x] =
            finished.pixels[static_cast<size_t>(y) * tile.width() + x];
      }
    }
  }

  /// Polls until `is_reached`; generous, for sanitizers.
  testing::AssertionResult wait_until(const std::function<bool()>& is_reached,
                                      double timeout_seconds = 60) {
    const auto start = Clock::now();
    do {
      poll();
      if (is_reached()) return testing::AssertionSuccess();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (seconds_since(start) < timeout_seconds);
    return testing::AssertionFailure()
           << "not reached; error: " << status_.error << ", samples " << status_.samples;
  }

  bool is_done() const {
    return status_.model && !status_.is_rendering && !status_.is_building && !status_.is_loading &&
           !status_.is_improving && status_.is_finished;
  }

  testing::AssertionResult show(const std::filesystem::path& path) {
    session_->set(edits_);
    session_->open(path);
    const auto loaded = wait_until([this] { return status_.model && !status_.is_loading; });
    return loaded ? wait_until([this] { return is_done(); }) : loaded;
  }

  std::filesystem::path folder_;
  Edits edits_;
  Status status_;
  tracer::Image picture_;
  std::unique_ptr<Session> session_ = std::make_unique<Session>([] {});
};

}  // namespace app
