// SPDX-License-Identifier: MIT
#include "tests/bench/compare/cycles_runs.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/support/virtual_display.h"
#include "tracer/scene/texture.h"
#include "tracer/scene/view_file.h"

namespace bench {
namespace {

tracer::Image read_exr(const std::filesystem::path& path) {
  const tracer::Texture texture = tracer::load_texture(path, tracer::TexelEncoding::linear);
  tracer::Image image{{texture.width, texture.height}, {}};
  image.pixels.reserve(static_cast<size_t>(texture.width) * texture.height);
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      image.pixels.emplace_back(texel_at(texture, texture.levels.front(), x, y));
    }
  }
  return image;
}

void take_away_set_up(std::vector<Snapshot>& ladder) {
  if (ladder.size() < 2) return;
  const Snapshot& shortest = ladder.front();
  const Snapshot& longest = ladder.back();
  const double seconds_a_sample =
      (longest.seconds - shortest.seconds) / (longest.samples - shortest.samples);
  const double set_up = std::max(shortest.seconds - seconds_a_sample * shortest.samples, 0.0);
  for (Snapshot& snapshot : ladder) {
    snapshot.seconds = std::max(snapshot.seconds - set_up, seconds_a_sample * snapshot.samples / 2);
  }
}

}  // namespace

std::optional<Blender> find_blender() {
  const std::string program = tests::find_program("blender");
  if (program.empty()) return std::nullopt;
  const std::string said = tests::ChildProgram(program, {"--version"}).wait().out;
  return Blender{program, said.substr(0, said.find('\n'))};
}

std::vector<Snapshot> render_with_cycles(const Blender& blender, const ErrorScene& scene, int seed,
                                         double longest_seconds) {
  const tests::TemporaryFolder folder;
  tests::ChildProgram child(
      blender.program.string(),
      {"-b", "--factory-startup", "--python",
       BOXWOOD_SOURCE_DIR "/tests/bench/compare/cycles_ladder.py", "--", scene.model.string(),
       tracer::view_path_of(scene.model).string(), std::to_string(scene.size_px.x),
       std::to_string(scene.size_px.y), folder.path().string(), std::to_string(seed),
       fmt::format("{}", longest_seconds)});
  const tests::ProgramResult result = child.wait(60 + 8 * longest_seconds);
  std::vector<Snapshot> ladder;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view mark = "LADDER ";
    if (!line.starts_with(mark)) continue;
    const auto said = nlohmann::json::parse(line.substr(mark.size()));
    const int samples = said.at("samples");
    ladder.push_back({static_cast<int>(ladder.size()), said.at("seconds"),
                      static_cast<double>(samples),
                      read_exr(folder.path() / fmt::format("{}.exr", samples))});
  }
  if (ladder.empty()) throw std::runtime_error("Cycles rendered nothing: " + result.err);
  take_away_set_up(ladder);
  return ladder;
}

}  // namespace bench
