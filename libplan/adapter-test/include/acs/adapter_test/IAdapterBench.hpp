#pragma once

#include <acs/adapter_test/IAdapterHost.hpp>
#include <acs/adapter_test/IVirtualTime.hpp>
#include <acs/core/Api.hpp>
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::AdapterTest
{

/// What the robot does with the next commands.
enum class EConduct : std::uint8_t
{
    Obeys,   ///< Executes each command.
    Slow,    ///< Drives and works several times slower, and answers late.
    Refuses, ///< Refuses each new drive and job. A refused job is not executed.
    Fails,   ///< A job ends without having been done.
    Repeats, ///< Obeys, and sends each message twice.
};

/// What the robot is really doing, known without the adapter.
struct RobotTruth
{
    std::string nodeID;       ///< The node on which it is, or which it passed last.
    bool bDriving = false;    ///< It moves.
    bool bWorking = false;    ///< It executes a job, and is not paused.
    std::size_t doneJobs = 0; ///< How often it has done a job, since MakeRobot.
    /// What is at its ports. nullopt: loads are not compared.
    std::optional<std::vector<Planning::PortLoad>> loads{};

    bool operator==(const RobotTruth&) const = default;
};

/// What the bench can do. Scenarios that need more are omitted.
struct BenchOptions
{
    /// At least five nodes. The robot of MakeRobot is on the first one and executes its jobs there.
    Planning::Route route;
    /// Maximum time for each answer, and for one edge of the route. Virtual time costs little: allow for a slow robot.
    std::chrono::milliseconds answerLimit{60'000};
    bool bSlow = true;         ///< SetConduct accepts EConduct::Slow; likewise the following.
    bool bRefuses = true;      ///< EConduct::Refuses.
    bool bFails = true;        ///< EConduct::Fails.
    bool bRepeats = true;      ///< EConduct::Repeats.
    bool bPausesDrives = true; ///< It stops on Pause while it drives.
    bool bPausesJobs = true;   ///< It stops on Pause while it works.
    bool bCancelsJobs = true;  ///< It ends a running job on CancelJob; otherwise it finishes the job.
    bool bCharges = true;      ///< It charges on the first node.
    bool bDrives = true;       ///< False: only jobs are commanded.
};

/// An adapter and the robot to which it is connected, in virtual time: what CheckAdapter needs of the author of an adapter.
/// The robot may be a simple model. It is not part of the adapter: it continues while the link is cut and while there is no
/// adapter.
class ACS_API IAdapterBench
{
public:
    IAdapterBench() = default;
    IAdapterBench(const IAdapterBench&) = delete;
    IAdapterBench& operator=(const IAdapterBench&) = delete;
    virtual ~IAdapterBench() = default;

    /// The same in each call.
    [[nodiscard]] virtual BenchOptions GetOptions() const = 0;

    /// A job that the robot can execute on the first node, after it has executed those with lower numbers (from 0). The
    /// suite sets planID, stepNo, jobID, commandID, progressToken, jobNumber and nodeID.
    [[nodiscard]] virtual Planning::StartJob MakeJob(std::size_t number) const = 0;

    /// A new robot on the first node of the route, which obeys, and a working link; no adapter. The time is valid until
    /// DestroyRobot.
    virtual void MakeRobot(IVirtualTime& time) = 0;

    /// A new adapter, as after the start of the ACS. It connects later, by a task, if the link works. The host is valid until
    /// DestroyRobot, but must not be called after DestroyAdapter.
    [[nodiscard]] virtual Planning::IRobotAdapter& MakeAdapter(IAdapterHost& host) = 0;

    /// The ACS has crashed. Messages that are in transit to the robot may still arrive.
    virtual void DestroyAdapter() = 0;

    /// Called last, without an adapter.
    virtual void DestroyRobot() = 0;

    /// Sends what the adapter wants to send. Called after every call of the adapter.
    virtual void OnAdapterCalled() = 0;

    /// Cuts the link, with what is in transit, or restores it. Not called twice with the same value; the link works at first.
    virtual void SetLink(bool bUp) = 0;

    /// How the robot behaves from its next command on. Called only with what the options allow.
    virtual void SetConduct(EConduct conduct) = 0;

    /// What the robot does at the current virtual time.
    [[nodiscard]] virtual RobotTruth GetTruth() const = 0;
};

} // namespace ACS::AdapterTest
