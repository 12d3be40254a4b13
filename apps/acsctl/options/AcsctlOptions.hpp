#pragma once

#include "options/ECommand.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsctl
{

constexpr std::string_view PROGRAM_NAME = "acsctl";

/// Where acsd is and how to identify there, as far as the command line states it.
struct ConnectionOptions
{
    std::optional<std::string> context;
    std::optional<std::string> url;
    std::optional<std::string> tokenFile;
    std::optional<std::string> ca;
    std::optional<std::string> certificate;
    std::optional<std::string> key;
};

/// The arguments of all commands; each command reads its own.
struct CommandArguments
{
    std::string id; ///< Of the plan, the robot, the place or the context.
    std::string jobID;
    std::int64_t number = 0; ///< Step or priority.
    /// on, off, done, failed, again, node, edge, station, bash, zsh; the code of an alarm; the type of an instant action.
    std::string word;
    std::vector<std::string> carriers;
    std::vector<std::string> parameters; ///< "KEY=VALUE", of an instant action.
    std::optional<std::string> reason;
    std::optional<std::string> state;
    std::optional<std::string> plan;
    std::optional<std::string> robot;
    std::optional<std::string> lot;
    std::optional<std::string> job;
    std::optional<std::string> transaction;
    std::optional<std::uint64_t> limit;
    std::optional<std::uint64_t> after;
    std::optional<std::string> types;
    std::optional<std::string> httpURL;
    std::vector<std::string> files; ///< Of traces; empty: acsd is asked.
    bool bCheck = false;
    bool bFollow = false;
    bool bTokenFromInput = false;
    bool bNotAwaited = false; ///< The outcome of an instant action.
};

/// The command line.
struct AcsctlOptions
{
    ECommand command = ECommand::Status;
    CommandArguments arguments;
    ConnectionOptions connection;
    std::chrono::milliseconds timeout{10'000};
    std::optional<std::chrono::milliseconds> watch;
    bool bJSON = false;
    bool bPlain = false; ///< Without colours.
    bool bYes = false;
};

} // namespace ACS::Acsctl
