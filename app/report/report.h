// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace afterglow {

/// Writes `folder`/report.html: one page that needs no other file and no network, with the curves,
/// the pictures and the tables of an experiment, or of all experiments whose folders lie in
/// `folder` (a suite), in the order of their names. The page appears whole or not at all, and the
/// same files give the same bytes.
///
/// The files of a run are described in docs/cli.md. InputError names the one that is missing or
/// malformed; Error, if the page cannot be written.
void writeReport(const std::filesystem::path& folder);

} // namespace afterglow
