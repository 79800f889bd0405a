// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace afterglow {

/// Returns the message of the exception of one kind that `act` throws; empty if it throws none.
template <class Exception, class Act>
std::string messageOf(Act act) {
    try {
        act();
    } catch (const Exception& error) {
        return error.what();
    }
    return "";
}

} // namespace afterglow
