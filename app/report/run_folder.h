// SPDX-License-Identifier: MIT
#pragma once

#include "app/report/picture_store.h"

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// What the page is told of a run, and the pictures that it shows, added to `pictures`:
///
///     run: experiment.json as it is
///     summary, timing: the same, of each variant by its name
///     metrics: { variant: { metric: { first: frame, values: [...] } } }, null where there is no
///              number, "inf" and "-inf" where it is infinite
///     images: { variant: { picture: [number of each of run.pictures], error: [...], lambda: ... },
///               reference: { picture: [...] } }, null where a map is not there
///
/// InputError names the file that is missing or malformed.
nlohmann::ordered_json readRunFolder(const std::filesystem::path& folder, PictureStore& pictures);

} // namespace afterglow
