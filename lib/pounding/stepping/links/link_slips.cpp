#include <pounding/stepping/links/link_slips.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {

LinkSlips::LinkSlips(const LinkSet& links)
    : links_(links), is_slipping_(static_cast<std::size_t>(links.size() - links.contacts()), false) {
  for (int i = 0; i < links.springs(); ++i)
    if (!links.is_coupled(links.contacts() + i) && links.spring(links.contacts() + i).slips()) {
      is_slipping_[i] = true;
      slipping_.push_back(i);
      springs_.push_back(i);
    }
  for (const Friction& friction : links.frictions()) {
    if (!friction.is_compliant()) continue;
    frictions_.push_back(&friction);
    for (int j = 0; j < friction.count; ++j) {
      is_slipping_[index(friction, j)] = true;
      slipping_.push_back(index(friction, j));
    }
  }
}

FrictionForce LinkSlips::friction_at(const Friction& friction, const Instant& x) const {
  TangentialMotion along;
  for (int j = 0; j < friction.count; ++j) along.set(j, links_.motion(friction.first + j, x));
  return links_.friction(friction, links_.motion(friction.contact, x), {.force = x.force[friction.contact]}, along);
}

void LinkSlips::start(Instant& x) const {
  for (const int i : springs_) {
    const int link = links_.contacts() + i;
    x.slip[i] = links_.spring(link).first_slip(links_.motion(link, x));
  }
  for (const Friction* friction : frictions_)
    for (int j = 0; j < friction->count; ++j)
      x.slip[index(*friction, j)] = links_.motion(friction->first + j, x).penetration;
}

void LinkSlips::release(Instant& x) const {
  for (const Friction* friction : frictions_) {
    if (links_.phase(friction->contact) != ContactPhase::open) continue;
    for (int j = 0; j < friction->count; ++j) {
      x.slip[index(*friction, j)] = links_.motion(friction->first + j, x).penetration;
      x.friction_slip_rate[index(*friction, j)] = 0;
    }
  }
}

Eigen::VectorXd LinkSlips::rates(const Instant& x) const {
  Eigen::VectorXd rates = x.friction_slip_rate;
  for (const int i : springs_) {
    const int link = links_.contacts() + i;
    rates[i] = links_.spring(link).slip_rate(links_.motion(link, x));
  }
  return rates;
}

Eigen::VectorXd LinkSlips::smooth_rates(const Instant& x) const {
  Eigen::VectorXd all = rates(x);
  for (const Friction* friction : frictions_) {
    const FrictionForce at = friction_at(*friction, x);
    for (int j = 0; j < friction->count; ++j) all[index(*friction, j)] = at.slip_rate[j];
  }
  return all;
}

void LinkSlips::rates_of_stage(const std::vector<int>& active, const std::function<LinkMotion(std::size_t)>& motion_of,
                               Eigen::Ref<Eigen::VectorXd> rates) const {
  rates.setZero();
  const auto number = [&](int link) {
    return static_cast<std::size_t>(std::lower_bound(active.begin(), active.end(), link) - active.begin());
  };
  const auto is_active = [&](int link) { return std::binary_search(active.begin(), active.end(), link); };
  for (const int i : springs_)
    if (const int link = links_.contacts() + i; is_active(link))
      rates[i] = links_.spring(link).slip_rate(motion_of(number(link)));
  for (const Friction* friction : frictions_) {
    if (!is_active(friction->contact)) continue;
    const LinkMotion normal = motion_of(number(friction->contact));
    TangentialMotion along;
    for (int j = 0; j < friction->count; ++j) along.set(j, motion_of(number(friction->first + j)));
    const FrictionForce at = links_.friction(*friction, normal, links_.law(friction->contact, normal), along);
    for (int j = 0; j < friction->count; ++j) rates[index(*friction, j)] = at.slip_rate[j];
  }
}

void LinkSlips::keep_friction_rates(const Eigen::VectorXd& rates, Instant& end) const {
  for (const Friction* friction : frictions_)
    for (int j = 0; j < friction->count; ++j) end.friction_slip_rate[index(*friction, j)] = rates[index(*friction, j)];
}

bool LinkSlips::sticks(const Friction& friction, const Instant& x) const {
  constexpr double at_limit = 1 - 1e-9;
  Sliding force{}, rate{};
  for (int j = 0; j < friction.count; ++j) {
    force[j] = x.force[friction.first + j];
    rate[j] = links_.motion(friction.first + j, x).rate;
  }
  return std::hypot(force[0], force[1]) <
         at_limit * x.force[friction.contact] * friction.limit(std::hypot(rate[0], rate[1]));
}

void LinkSlips::average_sliding_rates(const Instant& x, Trial& trial) const {
  for (const Friction* friction : frictions_) {
    if (sticks(*friction, trial.end)) continue;
    for (int j = 0; j < friction->count; ++j) {
      const int i = index(*friction, j);
      trial.end.friction_slip_rate[i] = (trial.end.slip[i] - x.slip[i]) / trial.h;
    }
  }
}

void LinkSlips::find_middle(const Instant& x, Trial& trial) const {
  const Eigen::VectorXd begin = rates(x), end = rates(trial.end);
  for (const int i : springs_)
    trial.middle[links_.contacts() + i].slip =
        0.5 * (x.slip[i] + trial.end.slip[i]) + trial.h / 8 * (begin[i] - end[i]);
  for (const Friction* friction : frictions_)
    for (int j = 0; j < friction->count; ++j) {
      LinkMotion& middle = trial.middle[friction->first + j];
      const int i = index(*friction, j);
      middle.slip = x.slip[i] + trial.h / 24 * (5 * begin[i] - end[i]);
      middle.lag = trial.h / 3;
    }
}

void LinkSlips::add_simpson_error(const Instant& x, const Trial& trial, double part, StepError& error) const {
  const Eigen::VectorXd begin = rates(x), end = rates(trial.end);
  const auto add = [&](int i, double middle) {
    const double missed = part * (trial.h / 6 * (begin[i] + 4 * middle + end[i]) - (trial.end.slip[i] - x.slip[i]));
    if (std::abs(missed) > std::abs(error.slip[i])) error.slip[i] = missed;
  };
  for (const int i : springs_) {
    const int link = links_.contacts() + i;
    add(i, links_.spring(link).slip_rate(trial.middle[link]));
  }
  for (const Friction* friction : frictions_) {
    const bool sticking = sticks(*friction, trial.end);
    TangentialMotion along;
    for (int j = 0; j < friction->count; ++j) along.set(j, trial.middle[friction->first + j]);
    const FrictionForce middle = links_.friction(*friction, trial.middle[friction->contact],
                                                 {.force = trial.force_middle[friction->contact]}, along);
    for (int j = 0; j < friction->count; ++j) {
      // At first contact a growing stiffness makes the relative error of any step equally large. Its force is small.
      if (sticking && friction->ratio == 0)
        add(index(*friction, j), middle.slip_rate[j]);
      else
        error.slip[index(*friction, j)] = 0;
    }
  }
}

}  // namespace pounding
