#include <pounding/sections/fibre_section.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace pounding::sections {
namespace {

/// Fibres evaluated before their sums, and partial sums of each total. Their order is fixed, so results are repeatable.
constexpr std::size_t chunk = 64, width = 4;

double strain_at(const Deformation& d, double y, double z) noexcept { return d[0] + z * d[1] - y * d[2]; }

/// Sums of forces and stiffnesses; in the plane without those of y.
template <bool is_plane>
class Sums {
 public:
  void add(const double* __restrict y, const double* __restrict z, const double* __restrict area,
           const double* __restrict stress, const double* __restrict slope, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; i += width)
      for (std::size_t l = 0; l < width; ++l) {
        const std::size_t j = i + l;
        const double force = area[j] * stress[j], stiffness = area[j] * slope[j], about_y = z[j] * stiffness;
        n_[l] += force, my_[l] += z[j] * force;
        k11_[l] += stiffness, k12_[l] += about_y, k22_[l] += z[j] * about_y;
        if constexpr (!is_plane) {
          mz_[l] -= y[j] * force;
          k13_[l] -= y[j] * stiffness, k23_[l] -= y[j] * about_y, k33_[l] += y[j] * y[j] * stiffness;
        }
      }
  }
  SectionResponse total() const noexcept {
    return {{sum(n_), sum(my_), sum(mz_)}, {sum(k11_), sum(k12_), sum(k13_), sum(k22_), sum(k23_), sum(k33_)}};
  }

 private:
  using Lanes = std::array<double, width>;
  static double sum(const Lanes& lanes) noexcept { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

  Lanes n_{}, my_{}, mz_{}, k11_{}, k12_{}, k13_{}, k22_{}, k23_{}, k33_{};
};

}  // namespace

std::optional<double> find_reversal(std::span<const double> t, std::span<const double> x) noexcept {
  const std::size_t last = x.size() - 1;
  // Extremum of the parabola through three samples, if it lies between two times.
  const auto vertex = [&](std::size_t j, double from, double to) -> std::optional<double> {
    const double before = (x[j] - x[j - 1]) / (t[j] - t[j - 1]), after = (x[j + 1] - x[j]) / (t[j + 1] - t[j]);
    const double bend = (after - before) / (t[j + 1] - t[j - 1]), slope = before + bend * (t[j] - t[j - 1]);
    const double at = t[j] - slope / (2 * bend);
    if (!(at > from && at < to)) return {};
    return x[j] - slope * slope / (4 * bend);
  };
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  for (const auto extreme : {high, low})
    if (const auto j = static_cast<std::size_t>(extreme - x.begin()); j > 0 && j < last)
      return vertex(j, t[j - 1], t[j + 1]).value_or(x[j]);
  if (const auto first = vertex(1, t[0], t[1])) return first;
  return vertex(last - 1, t[last - 1], t[last]);
}

FibreSection::FibreSection(std::vector<materials::AnyMaterial> materials, Fibres fibres)
    : materials_(std::move(materials)), fibres_(std::move(fibres)) {
  if (fibres_.empty()) throw std::invalid_argument("a section needs at least one fibre");
  for (const Fibre& fibre : fibres_) {
    laws::require_positive("area of a fibre", fibre.area);
    if (!std::isfinite(fibre.y) || !std::isfinite(fibre.z)) throw std::invalid_argument("a fibre is not at a point");
    if (fibre.material >= materials_.size())
      throw std::invalid_argument("a fibre has material " + std::to_string(fibre.material) + ", but there are " +
                                  std::to_string(materials_.size()));
  }
  std::ranges::stable_sort(fibres_, {}, &Fibre::material);
  extent_ = {Point{fibres_[0].y, fibres_[0].z}, Point{fibres_[0].y, fibres_[0].z}};
  for (const Fibre& fibre : fibres_) {
    if (groups_.empty() || groups_.back().material != fibre.material)
      groups_.push_back({fibre.material, y_.size(), y_.size()});
    ++groups_.back().end;
    y_.push_back(fibre.y), z_.push_back(fibre.z), area_.push_back(fibre.area);
    extent_[0] = {std::min(extent_[0].y, fibre.y), std::min(extent_[0].z, fibre.z)};
    extent_[1] = {std::max(extent_[1].y, fibre.y), std::max(extent_[1].z, fibre.z)};
  }
  for (auto* values : {&y_, &z_, &area_}) values->resize(fibres_.size() + width - 1);
  is_plane_ = extent_[0].y == 0 && extent_[1].y == 0;
}

FibreStates FibreSection::states() const {
  FibreStates states;
  for (const Group& group : groups_)
    std::visit([&]<class M>(const M& law) { states.push_back(materials::Lanes<M>(law, group.end - group.begin)); },
               materials_[group.material]);
  return states;
}

template <class States, class Function>
void FibreSection::each_chunk(States& states, const Deformation& deformation, const Function& function) const {
  alignas(64) std::array<double, chunk> strain;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    std::visit(
        [&]<class M>(const M& law) {
          auto& lanes = *std::get_if<materials::Lanes<M>>(&states[g]);
          for (std::size_t begin = groups_[g].begin; begin < groups_[g].end; begin += chunk) {
            const std::size_t count = std::min(chunk, groups_[g].end - begin);
            for (std::size_t i = 0; i < count; ++i) strain[i] = strain_at(deformation, y_[begin + i], z_[begin + i]);
            function(law, lanes, begin, begin - groups_[g].begin, count, strain.data());
          }
        },
        materials_[groups_[g].material]);
}

SectionResponse FibreSection::evaluate(const FibreStates& states, const Deformation& deformation) const noexcept {
  const auto with = [&](auto sums) {
    alignas(64) std::array<double, chunk> stress, slope;
    each_chunk(states, deformation,
               [&](const auto& law, const auto& lanes, std::size_t begin, std::size_t index, std::size_t count,
                   const double* strain) {
                 lanes.respond(law, index, count, strain, stress.data(), slope.data());
                 const std::size_t padded = (count + width - 1) / width * width;
                 for (std::size_t i = count; i < padded; ++i) stress[i] = slope[i] = 0;
                 sums.add(&y_[begin], &z_[begin], &area_[begin], stress.data(), slope.data(), padded);
               });
    return sums.total();
  };
  return is_plane_ ? with(Sums<true>()) : with(Sums<false>());
}

template <class States, class Function>
void FibreSection::each(States& states, const Function& function) const {
  for (std::size_t g = 0; g < groups_.size(); ++g)
    std::visit(
        [&]<class M>(const M& law) {
          auto& lanes = *std::get_if<materials::Lanes<M>>(&states[g]);
          for (std::size_t i = groups_[g].begin; i < groups_[g].end; ++i) function(law, lanes, i, i - groups_[g].begin);
        },
        materials_[groups_[g].material]);
}

void FibreSection::accept(FibreStates& states, const Deformation& deformation) const noexcept {
  each_chunk(states, deformation,
             [](const auto& law, auto& lanes, std::size_t, std::size_t index, std::size_t count, const double* strain) {
               lanes.accept(law, index, count, strain);
             });
}

Accepted FibreSection::accept(FibreStates& states, const StageSamples& samples, double min_reversal) const {
  Accepted accepted;
  if (may_reverse(samples)) {
    std::vector<double> strains(samples.deformations.size());
    each(states, [&](const auto& law, auto& lanes, std::size_t i, std::size_t index) {
      for (std::size_t j = 0; j < strains.size(); ++j) strains[j] = strain_at(samples.deformations[j], y_[i], z_[i]);
      const auto turn = find_reversal(samples.times, strains);
      if (!turn || std::min(std::abs(*turn - strains.front()), std::abs(*turn - strains.back())) < min_reversal) return;
      accepted.work += area_[i] * law.work(lanes.states()[index], *turn);
      lanes.accept(law, index, *turn);
      accepted.reversed = true;
    });
  }
  accepted.work += work(states, samples.deformations.back());
  accept(states, samples.deformations.back());
  return accepted;
}

bool FibreSection::may_reverse(const StageSamples& samples) const noexcept {
  // Strains are linear in y and z: if all four corners of the bounding box move in one direction, all fibres do.
  const auto& [times, deformations] = samples;
  const std::size_t last = times.size() - 1;
  bool has_up = false, has_down = false;
  for (const double y : {extent_[0].y, extent_[1].y})
    for (const double z : {extent_[0].z, extent_[1].z}) {
      const auto rate = [&, &t = times, &d = deformations](std::size_t j) {
        return (strain_at(d[j], y, z) - strain_at(d[j - 1], y, z)) / (t[j] - t[j - 1]);
      };
      const auto count = [&](double slope) { (slope > 0 ? has_up : has_down) = true; };
      for (std::size_t j = 1; j <= last; ++j) count(rate(j));
      // Slopes of the parabolas at both ends.
      count(rate(1) - (rate(2) - rate(1)) * (times[1] - times[0]) / (times[2] - times[0]));
      count(rate(last) +
            (rate(last) - rate(last - 1)) * (times[last] - times[last - 1]) / (times[last] - times[last - 2]));
    }
  return has_up && has_down;
}

double FibreSection::work(const FibreStates& states, const Deformation& deformation) const noexcept {
  double sum = 0;
  alignas(64) std::array<double, chunk> begin_strain, begin_stress, stress, slope;
  each_chunk(states, deformation,
             [&]<class M>(const M& law, const materials::Lanes<M>& lanes, std::size_t begin, std::size_t index,
                          std::size_t count, const double* strain) {
               const auto fibres = lanes.states().subspan(index, count);
               if constexpr (materials::Lanes<M>::in_lanes) {
                 for (std::size_t i = 0; i < count; ++i) begin_strain[i] = fibres[i].deformation;
                 lanes.respond(law, index, count, begin_strain.data(), begin_stress.data(), slope.data());
                 lanes.respond(law, index, count, strain, stress.data(), slope.data());
               }
               for (std::size_t i = 0; i < count; ++i) {
                 if constexpr (materials::Lanes<M>::in_lanes) {
                   // Straight paths of unloading or elastic fibres need no search for corners.
                   const double path = strain[i] - begin_strain[i], rise = stress[i] - begin_stress[i];
                   if (std::abs(rise - slope[i] * path) <= 1e-13 * law.stiffness() * std::abs(path)) {
                     sum += area_[begin + i] * (0.5 * (stress[i] + begin_stress[i]) * path);
                     continue;
                   }
                 }
                 sum += area_[begin + i] * law.work(fibres[i], strain[i]);
               }
             });
  return sum;
}

double FibreSection::stored(const FibreStates& states) const noexcept {
  double sum = 0;
  each(states, [&](const auto& law, const auto& lanes, std::size_t i, std::size_t index) {
    sum += area_[i] * law.stored(lanes.states()[index]);
  });
  return sum;
}

double FibreSection::lost(const FibreStates& states, const Deformation& deformation) const noexcept {
  double sum = 0;
  each(states, [&](const auto& law, const auto& lanes, std::size_t i, std::size_t index) {
    sum += area_[i] * hysteresis::lost(law, lanes.states()[index], strain_at(deformation, y_[i], z_[i]));
  });
  return sum;
}

bool FibreSection::forgets_small_reversals() const noexcept {
  return std::ranges::all_of(groups_, [&](const Group& group) {
    return std::visit([](const auto& law) { return materials::forgets_small_reversals(law); },
                      materials_[group.material]);
  });
}

}  // namespace pounding::sections
