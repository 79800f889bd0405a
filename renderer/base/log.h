// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

namespace afterglow {

enum class LogLevel { Debug, Info, Warning, Error };
using LogSink = std::function<void(LogLevel, std::string_view)>;

/// Hands one message, without a line end, to the sink. The sink of the beginning writes Info and
/// above to standard error. For what happens beside the work; failures are exceptions.
void log(LogLevel level, std::string_view message);

/// Replaces the sink for the whole process and returns the one before. An empty sink drops all.
LogSink setLogSink(LogSink sink);

} // namespace afterglow
