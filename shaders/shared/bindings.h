// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

const uint kTileSize = 8u;   // threads along each edge of a compute workgroup; a multiple of 8 in x
const uint kFrameBlock = 0u; // uniform block bindings
const uint kPassBlock = 1u;
const uint kStratumSize =
    3u; // pixels along each edge of a stratum; Schied et al. 2018, section 4.1

SHARED_END
