#pragma once

#include "common/process/TimerSet.hpp"
#include "operator/EventFeed.hpp"
#include "view/ChangeObserver.hpp"
#include "view/StateView.hpp"
#include "view/StateViewMaker.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/IPlanObserver.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The present state for operators, the events `changes` with what is different from the state before, and the events `entry`.
/// Used on the executor's thread.
class StateFeed final
{
public:
    struct Dependencies
    {
        boost::asio::any_io_executor executor;
        const Core::IClock& clock;
        const Planning::PlanEngine& engine;
        std::function<ProgramState()> getProgram;
        EventFeed& events;
    };

    /// Between two events at least.
    static constexpr Core::Duration INTERVAL = std::chrono::milliseconds(200);
    /// Between two events at most, if something has changed.
    static constexpr Core::Duration LONGEST_INTERVAL = std::chrono::seconds(1);

private:
    /// The view of a long queue takes long: the interval is at least this multiple of its time.
    static constexpr int SHARE = 20;
    /// Of plans that have ended since the last event.
    static constexpr std::size_t MAX_ENDED = 1'000;

    Dependencies _dependencies;
    StateViewMaker _maker;
    StateView _state;             ///< As it was published last.
    StateView _read;              ///< As it was read last.
    std::vector<PlanView> _ended; ///< Plans that have ended since the last update, in this order.
    ChangeObserver _entries;
    Apps::TimerSet<int> _timer;

public:
    /// All references must outlive the feed.
    explicit StateFeed(Dependencies dependencies);

    /// Updates the state every INTERVAL until Stop, less often if an update takes long.
    void Start();
    void Stop();

    /// The present state, which is valid until the next call. Publishes nothing.
    [[nodiscard]] const StateView& Read();

    /// Publishes what has changed: the present state is that of GetEventID then. Valid until the next call.
    [[nodiscard]] const StateView& Update();

    /// For the engine: publishes an event `entry` for each change.
    [[nodiscard]] Planning::IPlanObserver& GetObserver() noexcept;

    /// Number of the last event that contributed to the state.
    [[nodiscard]] std::uint64_t GetEventID() const noexcept;

private:
    void OnEntry(const ChangeEntry& entry, Core::Now now);
    [[nodiscard]] std::vector<PlanView> TakeEnded(const StateChanges& changes);
    void OnTimer();
};

} // namespace ACS::Acsd
