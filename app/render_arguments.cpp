// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "app/command_parser.h"
#include "app/commands.h"
#include "app/exit_code.h"
#include "app/option_error.h"
#include "app/option_values.h"
#include "app/render_command.h"
#include "tracer/render/write_image.h"

namespace app {
namespace {

constexpr int max_samples = 1 << 30;
constexpr double max_seconds = 1e7;
constexpr int max_improvement_rounds = 1000;

constexpr const char* usage =
    "boxwood render MODEL.obj -o PICTURE.{png,exr,pfm} [options]\n"
    "       boxwood render MODEL.obj --pixel X,Y --sample S [options]";
constexpr const char* examples =
    "  boxwood render cow.obj -o cow.png\n"
    "  boxwood render cow.obj -o cow.exr --time 30 --size 1920x1080\n"
    "  boxwood render cow.obj -o cow.png --error 1e-3 --allocation adaptive\n"
    "  boxwood render cow.obj -o cow.exr --aov albedo,normal,depth\n"
    "  boxwood render cow.obj -o cow.png --eye 3,2,4 --target 0,0.5,0 --fov 30\n"
    "  boxwood render cow.obj -o cow.pfm --bvh off --spp 1 --stats cow.json\n"
    "  boxwood render cow.obj --pixel 640,360 --sample 0";

std::vector<const tracer::Aov*> parse_aovs(const std::string& text) {
  std::vector<const tracer::Aov*> aovs;
  if (text == "all") {
    for (const tracer::Aov& aov : tracer::aovs()) aovs.push_back(&aov);
    return aovs;
  }
  for (size_t first = 0; first <= text.size();) {
    const size_t end = std::min(text.find(',', first), text.size());
    const tracer::Aov* aov = chosen_from(tracer::aovs(), text.substr(first, end - first));
    if (std::ranges::find(aovs, aov) == aovs.end()) aovs.push_back(aov);
    first = end + 1;
  }
  return aovs;
}

void add_output(CLI::App& app, RenderOptions& options) {
  add_path(app, "MODEL", "", "an OBJ file", [&](const auto& path) {
    options.model = path;
  })->required();
  add_path(app, "-o,--output", "FILE", "the picture: .png as seen, .exr and .pfm linear radiance",
           [&](const auto& path) {
             if (!tracer::is_writable_image(path)) {
               throw std::invalid_argument(
                   fmt::format("'{}' does not end in .png, .exr or .pfm", path.string()));
             }
             options.output = path;
           })
      ->group("Output");
  add_value(app, "--aov", "NAME,...|all",
            fmt::format("layers of an .exr: {}", names_in(tracer::aovs())),
            [&](const std::string& text) { options.aovs = parse_aovs(text); })
      ->group("Output");
  add_path(app, "--stats", "FILE", "counts, times and rays per second as JSON",
           [&](const auto& path) { options.stats_file = path; })
      ->group("Output");
  app.add_flag_callback(
         "-q,--quiet", [&] { options.is_quiet = true; }, "say nothing unless it fails")
      ->group("Output");
  add_value(app, "--pixel", "X,Y", "print the path of one sample of this pixel",
            [&](const std::string& text) { options.pixel = parse_pixel(text); })
      ->group("Output");
  add_value(app, "--sample", "S", "which of its samples [0]",
            [&](const std::string& text) {
              options.sample = static_cast<uint32_t>(parse_whole_number(text, 0, max_samples));
            })
      ->group("Output")
      ->needs("--pixel");
}

void add_picture(CLI::App& app, RenderOptions& options) {
  CLI::Option* samples =
      add_value(app, "--spp", "N", fmt::format("samples a pixel [{}]", default_sample_count),
                [&](const std::string& text) {
                  options.sample_count = parse_whole_number(text, 1, max_samples);
                });
  CLI::Option* time = add_value(
      app, "--time", "SECONDS", "or as many as this time allows",
      [&](const std::string& text) { options.seconds = parse_number(text, 0.001, max_seconds); });
  add_value(app, "--error", "E",
            "or until its error is at most this: relMSE, the mean of (x - r)^2 / (r^2 + 0.01)",
            [&](const std::string& text) { options.error = parse_number(text, 1e-9, 100); })
      ->group("Picture");
  samples->group("Picture");
  time->group("Picture")->excludes(samples);
  add_value(
      app, "--size", "WxH",
      fmt::format("in pixels [the view file's, else {}x{}]", default_size_px.x, default_size_px.y),
      [&](const std::string& text) { options.size_px = parse_size_px(text); })
      ->group("Picture");
  add_value(app, "--integrator", "NAME",
            fmt::format("{} [{}]", names_in(tracer::integrators()), options.integrator->name),
            [&](const std::string& text) {
              options.integrator = chosen_from(tracer::integrators(), text);
            })
      ->group("Picture");
  add_fields(app, "Picture", options.render);
  app.add_flag_callback(
         "--no-skip", [&] { options.render.skips = false; },
         "do what the scene does not need too: the same picture, later")
      ->group("Picture");
}

void add_camera(CLI::App& app, RenderOptions& options) {
  add_path(app, "--view", "FILE.json", "a saved view [MODEL.view.json, if it is there]",
           [&](const auto& path) { options.view_file = path; })
      ->group("Camera");
  const auto add_vector = [&](const char* name, const char* help,
                              std::optional<tracer::Vec3d>& value) {
    add_value(app, name, "X,Y,Z", help, [&value](const std::string& text) {
      value = parse_vec3(text);
    })->group("Camera");
  };
  add_vector("--eye", "where the camera is", options.eye);
  add_vector("--target", "what it looks at", options.target);
  add_vector("--up", "what is up in the picture", options.up);
  add_value(app, "--fov", "DEGREES", "vertical field of view", [&](const std::string& text) {
    options.fov_degrees = parse_number(text, 0.001, 179);
  })->group("Camera");
  add_value(app, "--sky", "R,G,B", "radiance from everywhere [the view file's, else 1,1,1]",
            [&](const std::string& text) { options.sky = parse_sky(text); })
      ->group("Camera");
}

void add_tree(CLI::App& app, RenderOptions& options) {
  const std::string names = names_in(tracer::builders());
  add_value(app, "--bvh", "NAME|off", fmt::format("{}, off [{}]", names, options.builder->name),
            [&options, names](const std::string& text) {
              options.builder = tracer::find_builder(text);
              if (options.builder || text == "off") return;
              throw std::invalid_argument(fmt::format("'{}' is none of {}, off", text, names));
            })
      ->group("Bounding volume hierarchy");
  add_value(app, "--layout", "NAME",
            fmt::format("{} [{}]", names_in(tracer::layouts()), options.layout->name),
            [&options](const std::string& text) {
              options.layout = chosen_from(tracer::layouts(), text);
            })
      ->group("Bounding volume hierarchy");
  add_fields(app, "Bounding volume hierarchy", options.build);
  add_value(app, "--improve-rounds", "N", "rounds of re-insertion that lower the tree's cost [0]",
            [&options](const std::string& text) {
              options.improvement_rounds = parse_whole_number(text, 0, max_improvement_rounds);
            })
      ->group("Bounding volume hierarchy");
  add_value(app, "--threads", "N", "threads to work on [all]", [&](const std::string& text) {
    options.thread_count = parse_whole_number(text, 1, max_threads);
  })->group("Bounding volume hierarchy");
}

}  // namespace

int run_render(const std::vector<std::string>& arguments) {
  CommandParser parser("render", "Renders an OBJ to a picture; no window, no display needed.",
                       usage, examples);
  RenderOptions options;
  add_output(parser.options(), options);
  add_picture(parser.options(), options);
  add_camera(parser.options(), options);
  add_environment(parser.options(), options.environment, "Camera");
  add_tree(parser.options(), options);
  if (parser.parse(arguments) == Parsed::help_was_printed) return exit_code::success;
  if (!options.output && !options.aovs.empty()) {
    throw OptionError("boxwood render: --aov needs a picture to put its layers into: -o FILE.exr");
  }
  if (!options.output && !options.pixel) {
    throw OptionError("boxwood render: say where the picture goes: -o FILE.png, .exr or .pfm");
  }
  return render_command(options);
}

}  // namespace app
