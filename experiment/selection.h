#pragma once

#include "experiment/past_trial.h"
#include "experiment/schedule.h"
#include "protocols/reader/protocol.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// Which trial comes next. A session asks anew before every trial, and resuming one is to ask with
// the rows there are: nothing else is remembered anywhere.

// As rows spell them: practice, main, catch; and break, of which there is no row.
std::string_view nameOf(PlannedTrial::Kind kind);

// std::nullopt: the session is at its end. Pure: the same protocol, slot (from 1) and history,
// which this function must have led to, always give the same.
//
// First all of the ordering's `practice`. Then main trials: in the order of the slot's row of its
// square (schedule.h), or as drawn for this slot, or as the answers have it (staircase.h,
// adaptive.h). After each catchEvery of them a catch trial and after each breakEvery a break, but
// none after the last. Conditions for practice and catch trials are no part of the rest.
//
// Roles: in the scheme `thesis`, those of all main trials are exchanged, or none; otherwise the
// base order of condition c in row r goes by the parity of r + c, and the second half of a square's
// slots complements the first. Further presentations of a condition have the roles of the one
// before backwards.
std::optional<PlannedTrial> next(const Protocol& protocol, int slot,
                                 std::span<const PastTrial> history);

// All of a session whose order answers do not change; empty where they do.
std::vector<PlannedTrial> planned(const Protocol& protocol, int slot);

// How many trials there are, breaks not counted; where answers decide, at most.
int longest(const Protocol& protocol);

// Where the slot is in the protocol's scheme; with blocks, in that of the block listed first.
Assignment assign(const Protocol& protocol, int slot);

} // namespace obscura
