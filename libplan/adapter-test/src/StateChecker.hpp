#pragma once

#include "FindingSink.hpp"
#include <acs/adapter_test/IAdapterBench.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace ACS::AdapterTest
{

/// Compares what the adapter reports about its robot with what the robot does.
class StateChecker
{
    FindingSink _sink;
    bool _bOnline = false;
    std::optional<Planning::StateChanged> _state; ///< Since the connection.
    std::set<std::string> _sentIDs;               ///< Drives and jobs that were commanded.
    std::string _lastSentID;
    bool _bPauseAsked = false;
    bool _bFaultAllowed = false; ///< The robot was made to fail or to refuse, or its job was cancelled.
    std::string _incompatibility;

public:
    explicit StateChecker(FindingSink sink);

    void OnCommand(const Planning::RobotCommand& command);
    void OnLink(const Planning::LinkChanged& event);
    void OnState(const Planning::StateChanged& event, const RobotTruth& truth);
    void OnCompatibility(const Planning::CompatibilityChanged& event);
    void OnJobFinished(const RobotTruth& truth);
    void OnConduct(EConduct conduct);
    /// A new adapter, which has reported nothing.
    void OnRestart();

    /// The robot is at rest, and the adapter has had time to report it.
    void VerifyAtRest(const RobotTruth& truth);
    /// The robot has received its last drive or job, and the adapter has had time to report it.
    void VerifyEvidence();

    [[nodiscard]] bool IsOnline() const noexcept;
    /// Null before the first state since the connection.
    [[nodiscard]] const Planning::StateChanged* GetStateOrNull() const noexcept;

private:
    void VerifyUsable();
    /// @param when Appended to the finding.
    void VerifyLoads(const RobotTruth& truth, std::string_view when);
};

} // namespace ACS::AdapterTest
