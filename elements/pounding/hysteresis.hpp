#pragma once
/// Hysteretic laws of storeys, hinges, devices and isolators, by type and by name. The target Pounding::laws; needs
/// only the standard library.

#include <pounding/hysteresis/all.hpp>
