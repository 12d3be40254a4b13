#pragma once

#include <acs/core/JsonText.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace ACS::Acsd
{

/// Read samples of a MONITOR. The result is nullopt if the sample has another form.

/// Sample of GET motor_on_state.
[[nodiscard]] std::optional<bool> ReadMotorOnOrNull(const Core::JsonText& sample);

/// The members of the answer to GET rgen that acsd uses.
struct GeneralState
{
    bool bPlaying = false; ///< A program runs.
    std::optional<std::int64_t> program;
    std::optional<std::int64_t> step;
};

[[nodiscard]] std::optional<GeneralState> ReadGeneralStateOrNull(const Core::JsonText& sample);

/// Sample of GET val_s32.
[[nodiscard]] std::optional<std::vector<std::int64_t>> ReadRelayWordsOrNull(const Core::JsonText& sample);

/// The err_code of a refused CONTROL, which some versions write as a string.
[[nodiscard]] std::optional<std::int64_t> ReadErrorCodeOrNull(const Core::JsonText& body);

} // namespace ACS::Acsd
