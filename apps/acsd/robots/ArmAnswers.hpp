#pragma once

#include <acs/core/JsonText.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace ACS::Acsd
{

/// What samples of a MONITOR say; nullopt where they say something else.

/// Of GET motor_on_state.
[[nodiscard]] std::optional<bool> ReadMotorOnOrNull(const Core::JsonText& sample);

/// Of the answer to GET rgen what is of interest here.
struct GeneralState
{
    bool bPlaying = false; ///< A program runs.
    std::optional<std::int64_t> program;
    std::optional<std::int64_t> step;
};

[[nodiscard]] std::optional<GeneralState> ReadGeneralStateOrNull(const Core::JsonText& sample);

/// Of GET val_s32.
[[nodiscard]] std::optional<std::vector<std::int64_t>> ReadRelayWordsOrNull(const Core::JsonText& sample);

/// The err_code of a refused CONTROL, which some versions write as a string.
[[nodiscard]] std::optional<std::int64_t> ReadErrorCodeOrNull(const Core::JsonText& body);

} // namespace ACS::Acsd
