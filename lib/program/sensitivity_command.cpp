#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pounding/core/error.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/run/run.hpp>
#include "commands.hpp"

namespace pounding::program {
namespace {

// Maxima over all links and structures of one run.
struct Response {
  double factor = 1;
  int impacts = 0;
  double force = 0, penetration = 0, impulse = 0, drift = 0, displacement = 0, acceleration = 0;  // SI
};

double largest(const std::vector<double>& values, double so_far) {
  for (const double value : values) so_far = std::fmax(so_far, value);
  return so_far;
}

Response response_of(const Summary& summary, double factor) {
  Response r{.factor = factor};
  for (const LinkSummary& link : summary.links) {
    r.impacts += link.impacts;
    r.force = std::fmax(r.force, link.peak_force);
    r.penetration = std::fmax(r.penetration, link.peak_penetration);
    r.impulse += link.impulse;
  }
  for (const StructureSummary& s : summary.structures) {
    r.drift = largest(s.peak_drift, r.drift);
    r.displacement = largest(s.peak_displacement, r.displacement);
    r.acceleration = largest(s.peak_acceleration, r.acceleration);
  }
  return r;
}

Response run_with(const Input& input, double factor) {
  Model model = read_model(input, petsc::lowest_modes, factor);
  if (model.links.empty())
    throw InputError(fmt::format("{}: the model has no links and therefore no contact stiffness", input.file()));
  model.compare_no_pounding = false;
  return response_of(run(model).summary, factor);
}

// Exponent p of value = constant factor^p, from the first and last rows.
double power(const Response& first, const Response& last, double Response::* value) {
  return std::log(last.*value / first.*value) / std::log(last.factor / first.factor);
}

double change(const std::vector<Response>& rows, double Response::* value) {
  double low = HUGE_VAL, high = 0;
  for (const Response& r : rows) {
    low = std::fmin(low, r.*value);
    high = std::fmax(high, r.*value);
  }
  return low > 0 ? high / low - 1 : 0;
}

void print(const std::vector<Response>& rows) {
  std::puts("stiffness  impacts  peak force  penetration     impulse       drift  displacement  acceleration");
  std::puts("                           (kN)         (mm)      (kN s)        (mm)          (mm)       (m/s^2)");
  for (const Response& r : rows)
    fmt::print("{:>9}{:9}{:12.1f}{:13.4f}{:12.2f}{:12.4f}{:14.4f}{:14.4f}\n", fmt::format("x {:g}", r.factor),
               r.impacts, r.force / 1e3, 1e3 * r.penetration, r.impulse / 1e3, 1e3 * r.drift, 1e3 * r.displacement,
               r.acceleration);
  const Response &first = rows.front(), &last = rows.back();
  if (first.factor == last.factor || !(first.force > 0) || !(last.force > 0)) return;
  fmt::print(
      "\nThe peak force grows as the stiffness to the power {:.2f}, the acceleration to the power {:.2f}.\n"
      "The drift changes by {:.1f} %, the displacement by {:.1f} %.\n"
      "The more a value changes, the more accurately the stiffness must be known.\n",
      power(first, last, &Response::force), power(first, last, &Response::acceleration),
      100 * change(rows, &Response::drift), 100 * change(rows, &Response::displacement));
}

void print_json(const std::vector<Response>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Response& r : rows)
    all.push_back({{"factor", r.factor},
                   {"impacts", r.impacts},
                   {"peak_force", r.force},
                   {"peak_penetration", r.penetration},
                   {"impulse", r.impulse},
                   {"peak_drift", r.drift},
                   {"peak_displacement", r.displacement},
                   {"peak_acceleration", r.acceleration}});
  std::puts(all.dump().c_str());
}

}  // namespace

void add_sensitivity(CLI::App& app) {
  struct Arguments {
    std::string model;
    std::vector<double> factors{0.1, 0.3, 1, 3, 10};
    bool json = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("sensitivity", "Sensitivity to the contact stiffness: run MODEL with each factor");
  command->add_option("MODEL", arguments->model, "Input file (YAML)")->required();
  is_positive(command->add_option("--factors", arguments->factors, "Factors of the contact stiffness, such as 0.1,1,10")
                  ->delimiter(','))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print one JSON list");
  command->callback([arguments] {
    const petsc::Environment environment;
    const Input input = Input::read_file(arguments->model);
    std::vector<Response> rows;
    const bool shows_progress = isatty(STDERR_FILENO) != 0;
    for (const double factor : arguments->factors) {
      if (shows_progress) fmt::print(stderr, "\rrun {} of {} ", rows.size() + 1, arguments->factors.size());
      rows.push_back(run_with(input, factor));
    }
    if (shows_progress) fmt::print(stderr, "\r\033[K");
    if (arguments->json)
      print_json(rows);
    else
      print(rows);
  });
}

}  // namespace pounding::program
