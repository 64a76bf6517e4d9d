/// The binary interface of version 1, on 64-bit machines: programs built against it keep running.

#include <cstddef>

#include <pounding.h>

static_assert(PND_INTERFACE == 1);
static_assert(PND_OK == 0 && PND_BAD_ARGUMENT == 1 && PND_OUT_OF_MEMORY == 2 && PND_FAILED == 3);
static_assert(PND_REQUIRED == 0 && PND_OPTIONAL == 1 && PND_DAMPING == 2);

#if defined(__LP64__)
static_assert(sizeof(pnd_value) == 16 && offsetof(pnd_value, value) == 8);
static_assert(sizeof(pnd_contact) == 64 && offsetof(pnd_contact, touching) == 0 &&
              offsetof(pnd_contact, indentation) == 8 && offsetof(pnd_contact, closing_speed) == 16 &&
              offsetof(pnd_contact, damping) == 24 && offsetof(pnd_contact, largest_penetration) == 32 &&
              offsetof(pnd_contact, slip) == 40);
static_assert(sizeof(pnd_response) == 24 && offsetof(pnd_response, force) == 0 &&
              offsetof(pnd_response, by_penetration) == 8 && offsetof(pnd_response, by_rate) == 16);
static_assert(sizeof(pnd_free_impact) == 56 && offsetof(pnd_free_impact, restitution) == 0 &&
              offsetof(pnd_free_impact, peak_force) == 8 && offsetof(pnd_free_impact, peak_penetration) == 16 &&
              offsetof(pnd_free_impact, time_of_peak) == 24 && offsetof(pnd_free_impact, duration) == 32 &&
              offsetof(pnd_free_impact, impulse) == 40 && offsetof(pnd_free_impact, energy_lost) == 48);
static_assert(sizeof(pnd_law_info) == 64 && offsetof(pnd_law_info, source) == 24 &&
              offsetof(pnd_law_info, parameters) == 32 && offsetof(pnd_law_info, formulas) == 40 &&
              offsetof(pnd_law_info, may_pull) == 48 && offsetof(pnd_law_info, leaves_indentation) == 52 &&
              offsetof(pnd_law_info, instantaneous) == 56);
static_assert(sizeof(pnd_parameter_info) == 40 && offsetof(pnd_parameter_info, unit) == 8 &&
              offsetof(pnd_parameter_info, meaning) == 16 && offsetof(pnd_parameter_info, typical) == 24 &&
              offsetof(pnd_parameter_info, need) == 32);
static_assert(sizeof(pnd_formula_info) == 24 && offsetof(pnd_formula_info, source) == 8 &&
              offsetof(pnd_formula_info, note) == 16);
#endif
