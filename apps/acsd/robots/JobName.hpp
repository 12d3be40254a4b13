#pragma once

#include <acs/core/ESegmentKind.hpp>

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// One name of a template, without its braces: "from", "to.cp", "station.type".
struct JobName
{
    enum class ESubject : std::uint8_t
    {
        From,
        To,
        Position, ///< The station where the robot works.
        Place, ///< The job's own fixed place: of from and to the one that is no port of the robot, else the position.
        Carrier,
        RobotPort, ///< Of from and to the port of the robot, without the robot's name.
        JobNumber,
        Station, ///< A key of the table of the place's station.
    };

    ESubject subject = ESubject::From;
    std::optional<Core::ESegmentKind> segment; ///< Of From, To and Position: the number of this segment.
    std::string key;                           ///< Of Station.

    bool operator==(const JobName&) const = default;
};

/// The error is a text for a person, with the names that there are.
[[nodiscard]] tl::expected<JobName, std::string> ParseJobName(std::string_view text);

/// As it stands in a template: "{to.cp}".
[[nodiscard]] std::string MakeNameText(const JobName& name);

} // namespace ACS::Acsd
