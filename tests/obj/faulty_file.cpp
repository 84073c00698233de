// SPDX-License-Identifier: MIT
#include "tests/obj/faulty_file.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace tests {
namespace {

int64_t line_count(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

void expect_program_says(const std::string& path, const FaultyFile& file) {
  const ProgramResult result = run_boxwood({"info", path, "--bvh", "off"});
  EXPECT_EQ(result.exit_code, file.triangles > 0 ? 0 : 2) << file.what << '\n' << result.err;
  if (file.triangles == 0) {
    EXPECT_EQ(line_count(result.err), 1) << file.what << '\n' << result.err;
  }
  for (const ExpectedFault& fault : file.faults) {
    if (file.triangles == 0) continue;
    const std::string place = path + ':' + std::to_string(fault.line) + ": ";
    EXPECT_NE(result.err.find(place), result.err.npos) << file.what << '\n' << result.err;
  }
  const std::string total = std::to_string(file.warning_count()) + " warnings in all";
  const bool has_total = result.err.find(total) != result.err.npos;
  EXPECT_EQ(has_total, file.warning_count() > 10) << file.what << '\n' << result.err;
}

void expect_warnings(const tracer::Warnings& warnings, const std::string& path,
                     const FaultyFile& file) {
  EXPECT_EQ(warnings.count(), file.warning_count()) << file.what;
  const auto kept = static_cast<size_t>(std::min<int64_t>(10, file.warning_count()));
  ASSERT_EQ(warnings.messages().size(), kept) << file.what;
  for (size_t i = 0; i < std::min(kept, file.faults.size()); ++i) {
    const tracer::Message& message = warnings.messages()[i];
    EXPECT_EQ(message.path, path) << file.what;
    EXPECT_EQ(message.line, file.faults[i].line) << file.what << '\n' << message.text();
    EXPECT_NE(message.what.find(file.faults[i].reason), message.what.npos) << file.what << '\n'
                                                                           << message.text();
  }
}

}  // namespace

Loading load(const std::filesystem::path& path) {
  tracer::Progress progress;
  try {
    return {import_obj(path, progress), ""};
  } catch (const tracer::LoadError& error) {
    return {std::nullopt, error.what()};
  }
}

void expect_as_described(const FaultyFile& file) {
  const TemporaryFolder folder;
  const std::string path = folder.write("model.obj", file.bytes);
  const Loading loading = load(path);
  ASSERT_EQ(loading.scene.has_value(), file.triangles > 0) << file.what << '\n' << loading.error;
  if (loading.scene) {
    EXPECT_EQ(loading.scene->scene.mesh->triangle_count(), file.triangles) << file.what;
    EXPECT_EQ(loading.scene->dropped_faces, file.dropped_faces) << file.what;
    expect_warnings(loading.scene->warnings, path, file);
  } else {
    for (const ExpectedFault& fault : file.faults) {
      EXPECT_NE(loading.error.find(fault.reason), loading.error.npos) << loading.error;
    }
  }
  expect_program_says(path, file);
}

void expect_refused(const std::filesystem::path& path, const std::string& reason) {
  const Loading loading = load(path);
  EXPECT_FALSE(loading.scene);
  EXPECT_NE(loading.error.find(path.string() + ": " + reason), loading.error.npos) << loading.error;
  const ProgramResult result = run_boxwood({"info", path.string()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(line_count(result.err), 1) << result.err;
  EXPECT_NE(result.err.find(reason), result.err.npos) << result.err;
}

tracer::Vec3d summed_area(const tracer::Mesh& mesh) {
  tracer::Vec3d sum(0.0);
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    sum += 0.5 * triangle_at(mesh, i).area_normal();
  }
  return sum;
}

double total_area(const tracer::Mesh& mesh) {
  double sum = 0;
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) sum += triangle_at(mesh, i).area();
  return sum;
}

}  // namespace tests
