// Compares many random rows of the study kernel and of the solver of runs.
//
//   compare_rows LOG.txt ROWS [SEED]
//
// Continues after the rows in LOG until it has ROWS of them. Each line has number, law, maximum differences of
// displacements, forces, impulse, energy lost and accelerations, the impacts, and how many of them differ. Then prints
// quantiles, and every row with a difference above 1e-3, together with the differences of both from the kernel at a
// tolerance of 1e-12, and those of the solver at 1e-9: a row is explained if these vanish.

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/petsc/environment.hpp>

#include "study/random_rows.hpp"

namespace {

using namespace pounding;
using namespace pounding::study;

struct Line {
  unsigned number = 0;
  std::string law;
  Differences d;
};

std::vector<Line> read(const std::string& path) {
  std::vector<Line> lines;
  std::ifstream file(path);
  for (std::string text; std::getline(file, text);) {
    Line line;
    std::istringstream words(text);
    Differences& d = line.d;
    if (words >> line.number >> line.law >> d.displacement >> d.force >> d.impulse >> d.energy >> d.acceleration >>
            d.impacts >> d.more_impacts &&
        line.number == lines.size())
      lines.push_back(line);
  }
  return lines;
}

std::string text(const Differences& d) {
  return fmt::format("{:.1e} {:.1e} {:.1e} {:.1e} {:.1e} {} {}", d.displacement, d.force, d.impulse, d.energy,
                     d.acceleration, d.impacts, d.more_impacts);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "compare_rows LOG.txt ROWS [SEED]\n";
    return 1;
  }
  const auto rows = static_cast<unsigned>(std::atol(argv[2])),
             seed = static_cast<unsigned>(argc > 3 ? std::atol(argv[3]) : 1);
  try {
    const petsc::Environment environment;
    std::vector<Line> lines = read(argv[1]);
    std::ofstream log(argv[1], std::ios::app);
    for (auto number = static_cast<unsigned>(lines.size()); number < rows; ++number) {
      const RandomRow row(seed, number);
      const Model model = row.model(1e-6);
      lines.push_back({number, std::string(row.law()), differences(by_kernel(model, 1e-7), by_solver(model))});
      log << fmt::format("{} {} {}", number, row.law(), text(lines.back().d)) << std::endl;
    }
    const auto show = [&](const char* name, double Differences::* part) {
      std::vector<double> values;
      for (const Line& line : lines) values.push_back(line.d.*part);
      std::cout << fmt::format("{:12s} 50 % {:.1e}  90 % {:.1e}  99 % {:.1e}  99.9 % {:.1e}  all {:.1e}\n", name,
                               quantile(values, 0.5), quantile(values, 0.9), quantile(values, 0.99),
                               quantile(values, 0.999), quantile(values, 1));
    };
    std::cout << lines.size() << " rows\n";
    show("displacement", &Differences::displacement), show("force", &Differences::force),
        show("impulse", &Differences::impulse);
    show("energy", &Differences::energy), show("acceleration", &Differences::acceleration);
    for (const Line& line : lines) {
      if (!(line.d.worst() > 1e-3)) continue;
      const RandomRow row(seed, line.number);
      const Answer truth = by_kernel(row.model(1e-6), 1e-12);
      std::cout << fmt::format("{} {} {}\n    kernel at 1e-7 {}\n    solver at 1e-6 {}\n    solver at 1e-9 {}",
                               line.number, line.law, text(line.d),
                               text(differences(by_kernel(row.model(1e-6), 1e-7), truth)),
                               text(differences(by_solver(row.model(1e-6)), truth)),
                               text(differences(by_solver(row.model(1e-9)), truth)))
                << std::endl;
    }
  } catch (const std::exception& error) {
    std::cerr << "compare_rows: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
