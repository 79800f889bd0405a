// SPDX-License-Identifier: MIT
// Compiled for its precompiled headers only.
