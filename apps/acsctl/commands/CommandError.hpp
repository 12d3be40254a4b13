#pragma once

#include "ExitCodes.hpp"

#include <tl/expected.hpp>

#include <string>
#include <utility>

namespace ACS::Acsctl
{

/// Why a command failed: its exit code and a sentence for standard error.
struct CommandError
{
    int exitCode = EXIT_REFUSED;
    std::string text;
};

template <typename T>
using Outcome = tl::expected<T, CommandError>;

[[nodiscard]] inline tl::unexpected<CommandError> FailWith(int exitCode, std::string text)
{
    return tl::make_unexpected(CommandError{exitCode, std::move(text)});
}

} // namespace ACS::Acsctl
