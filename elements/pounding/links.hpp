#pragma once
/// Gap links for codes with structures of their own: the target Pounding::links.

#include <pounding/laws/all.hpp>
#include <pounding/laws/by_name.hpp>
#include <pounding/links/friction.hpp>
#include <pounding/links/gap_link.hpp>
