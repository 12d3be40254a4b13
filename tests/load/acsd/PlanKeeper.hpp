#pragma once

#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include "TickLog.hpp"
#include <acs/protocol_beast/ISessionHandler.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>

namespace ACS::Load
{

/// Counts of the reports of acsd and of errors.
struct KeeperCount
{
    std::uint64_t reports = 0;  ///< Of plans, steps and jobs.
    std::uint64_t statuses = 0; ///< Of robots.
    std::uint64_t completed = 0;
    std::uint64_t positions = 0;
    std::uint64_t errors = 0;
    std::string firstError;
};

/// The plans that a PlanKeeper keeps running.
struct KeptPlans
{
    std::size_t robots = 0;
    std::size_t plans = 0; ///< At a time: one in each of this number of cells.
    /// Whether every second plan of a cell ends in its neighbour, so that robots meet and return to their parking positions.
    bool bToNeighbours = false;
};

/// An MCS that keeps a plan running in cells of a CellSite: when one ends, it sends the next. Plans that it has not sent are
/// counted only.
class PlanKeeper final : private ProtocolBeast::ISessionHandler
{
    Apps::SystemClock _clock;
    Apps::SystemRandom _random;
    std::unique_ptr<ProtocolBeast::McsServer> _server;
    const KeptPlans _kept;
    std::uint64_t _plans = 0;
    std::set<std::string> _online;  ///< Robots reported as connected.
    std::set<std::string> _placed;  ///< Robots reported as connected, with a known position.
    std::set<std::string> _idle;    ///< Robots reported as idle before the first plan.
    std::set<std::string> _running; ///< Plans.
    KeeperCount _count;
    TickLog _positions;

public:
    /// Throws std::runtime_error if it cannot listen.
    PlanKeeper(boost::asio::io_context& context, const KeptPlans& kept);

    [[nodiscard]] std::uint16_t GetPort() const;

    /// Whether every robot has been reported as connected.
    [[nodiscard]] bool IsEveryoneOnline() const noexcept;
    /// Whether the position of every robot has been known.
    [[nodiscard]] bool IsEveryonePlaced() const noexcept;
    /// Whether every robot waits for work.
    [[nodiscard]] bool IsEveryoneIdle() const noexcept;
    /// Sends one plan for each cell that is to have one.
    void SendFirstPlans();
    [[nodiscard]] std::size_t CountRunning() const noexcept;

    /// Resets the counts except the errors.
    void ResetCounts();
    [[nodiscard]] const KeeperCount& GetCount() const noexcept;
    [[nodiscard]] const TickLog& GetPositions() const noexcept;

private:
    void OnSessionEvent(const Protocol::SessionEvent& event) override;
    void OnRequest(const Protocol::AcsRequest& request);
    void OnStatus(const Protocol::RobotStatusUpdate& status);
    void OnPlanReport(const Protocol::PlanReport& report);
    void OnPositions(const Protocol::RobotPositionUpdate& update);
    [[nodiscard]] Protocol::ExecutionPlan MakeTransport(std::size_t cell, std::uint64_t number) const;
    void SendPlan(std::size_t cell);
    void CountError(std::string_view what);
};

} // namespace ACS::Load
