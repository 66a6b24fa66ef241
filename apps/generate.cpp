// umbrella generate: analytic samples.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/option_checks.h"
#include "apps/shapes.h"
#include "io/points.h"

namespace command {
namespace {

constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 27U;

struct Options {
  std::string shape;
  std::uint64_t n = 0;
  std::uint64_t seed = 1;
  std::optional<double> noise;
  std::string out = "-";
};

std::string list_of_shapes() {
  std::string text = "Shapes:\n";
  for (const shapes::Shape& shape : shapes::all()) {
    std::string name(shape.name);
    name.resize(13, ' ');
    text += "  " + name + std::string(shape.description) +
            (shape.dimension == 2 ? " (plane)\n" : "\n");
  }
  return text + R"(
Examples:
  umbrella generate knot -n 10000 -o knot.ply
  umbrella generate star -n 200 | umbrella reconstruct - -o star.obj)";
}

ExitCode generate(const Options& options) {
  const auto points = shapes::sample(
      options.shape, options.n, {.seed = options.seed, .noise = options.noise});
  int dimension = 3;
  for (const shapes::Shape& shape : shapes::all())
    if (shape.name == options.shape) dimension = shape.dimension;
  io::write_points(options.out, {dimension, points});
  return ExitCode::Done;
}

}  // namespace

void add_generate(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* const sub =
      app.add_subcommand("generate", "Sample an analytic shape");
  sub->footer(list_of_shapes());
  std::vector<std::string> names;
  for (const shapes::Shape& shape : shapes::all())
    names.emplace_back(shape.name);
  sub->add_option("shape", options->shape, "One of the shapes below")
      ->required()
      ->check([names](const std::string& name) {
        for (const std::string& known : names)
          if (name == known) return std::string();
        return "no shape is called '" + name + "'";
      })
      ->type_name("SHAPE");
  sub->add_option("-n,--count", options->n, "Number of points, 1 to 2^27")
      ->required()
      ->check(CLI::Range(std::uint64_t{1}, kMaxPoints).description(""))
      ->type_name("N");
  sub->add_option("--seed", options->seed, "Another seed, other points [1]")
      ->check(count_problem)
      ->type_name("S");
  sub->add_option("--noise", options->noise,
                  "Largest displacement of a coordinate, in distances of "
                  "neighbours [knot 0.05, others 0]")
      ->type_name("X");
  sub->add_option("-o,--output", options->out,
                  "Point file: .ply, .obj or text [-, standard output]")
      ->check(path_problem)
      ->type_name("FILE");
  sub->callback([options, &exit_code] { exit_code = generate(*options); });
}

}  // namespace command
