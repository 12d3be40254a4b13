#pragma once

#include <string_view>

namespace ACS::Acsd
{

/// Kinds of records that are answers from outside, or outputs with an answer: a replay needs their content.
inline constexpr std::string_view RANDOM_KIND = "random";
inline constexpr std::string_view REGISTERED_KIND = "registered";
inline constexpr std::string_view UNREGISTERED_KIND = "not registered";
inline constexpr std::string_view JOB_CHECK_KIND = "job check";
inline constexpr std::string_view REPORT_KIND = "report";
inline constexpr std::string_view COMMAND_KIND = "command";
inline constexpr std::string_view HELD_REPORT_KIND = "report held"; ///< Not accepted by the session yet.

/// The record before all others of a run: the program, its configuration and its site.
inline constexpr std::string_view BEGIN_KIND = "begin";

} // namespace ACS::Acsd
