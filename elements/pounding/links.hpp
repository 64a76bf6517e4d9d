#pragma once
/// Contact for the structures of a host program: laws, gap links, friction, the list of impacts. The target
/// Pounding::links.

#include <pounding/laws.hpp>
#include <pounding/links/contact.hpp>
#include <pounding/links/friction.hpp>
#include <pounding/links/gap_contact.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/links/impact_log.hpp>
#include <pounding/links/impact_row.hpp>
