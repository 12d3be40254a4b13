#pragma once

#include <cstdint>
#include <string>

namespace ACS::Testing
{

/// A message of the reference robot's protocol, in either direction.
struct ReferenceMessage
{
    enum class EKind : std::uint8_t
    {
        // To the robot.
        Go,  ///< To the node, which is next to its own; without effect if it is on its way there.
        Do,  ///< The job; a job that it knows is not executed again.
        Ask, ///< For the job.
        Cancel,
        Pause,
        Resume,
        Charge,
        StopCharging,
        // From the robot.
        State,     ///< After each connection and with each change.
        GoRefused, ///< ID: of the Go.
        JobState,  ///< Running, done, failed, refused or unknown: not executed, and it will not be.
    };

    EKind kind = EKind::State;
    std::string id = {};     ///< Of a Go, or the commandID of a job. State: the last drive or job that it has received.
    std::string nodeID = {}; ///< Go: the target. State: the last node.
    std::string nextID = {}; ///< State: the node ahead; empty: it is stationary on its node.
    std::string goID = {};   ///< State: the last Go that it has received, also if it has refused it.
    std::string text = {};   ///< JobState.
    bool bPaused = false;
    bool bCharging = false;
    bool bLoaded = false;
};

} // namespace ACS::Testing
