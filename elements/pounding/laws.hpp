#pragma once
/// Contact laws, by type and by name, their damping formulas and free impacts. The target Pounding::laws; needs only
/// the standard library.

#include <pounding/laws/all.hpp>
#include <pounding/laws/by_name.hpp>
#include <pounding/laws/free_impact.hpp>
