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
        Place,    ///< The job's own fixed place: from or to, whichever is not a port of the robot; else the position.
        Carrier,
        RobotPort, ///< from or to, whichever is a port of the robot, without the robot's name.
        JobNumber,
        Station, ///< A key in the table of the place's station.
    };

    ESubject subject = ESubject::From;
    std::optional<Core::ESegmentKind> segment; ///< For From, To and Position: the number of this segment.
    std::string key;                           ///< For Station.

    bool operator==(const JobName&) const = default;
};

/// The error is a sentence that lists the known names.
[[nodiscard]] tl::expected<JobName, std::string> ParseJobName(std::string_view text);

/// As written in a template: "{to.cp}".
[[nodiscard]] std::string MakeNameText(const JobName& name);

} // namespace ACS::Acsd
