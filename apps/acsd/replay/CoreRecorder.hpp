#pragma once

#include "AcsdCore.hpp"
#include "replay/CoreRecord.hpp"
#include "replay/ICoreRecorder.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Passes all calls between AcsdCore and its surroundings, and describes each input, each output and each answer from outside as a
/// CoreRecord. The clock does not advance during an input, so that the records have all times that the core has read.
class CoreRecorder final : public ICoreRecorder,
                           private IAcsdOutput,
                           private IMcsOutput,
                           private Core::IClock,
                           private Core::IRandom
{
public:
    using RecordHandler = std::function<void(const CoreRecord& record)>;

private:
    class WatchedCheck;

    RecordHandler _handler;
    std::optional<AcsdCore::Dependencies> _real;
    Core::Now _now;
    std::size_t _depth = 0;                        ///< Number of inputs that have not ended.
    std::vector<std::uint64_t> _drawn;             ///< In the current input.
    mutable bool _bRegistered = false;             ///< As recorded last.
    std::map<AcsdTimer, Core::SteadyTime> _timers; ///< When each running one is due.
    bool _bStopped = false;

public:
    explicit CoreRecorder(RecordHandler handler);

    /// The dependencies to give to the core instead of these. Call it once, before any other function. The recorder outlives the
    /// core.
    [[nodiscard]] AcsdCore::Dependencies Wrap(const AcsdCore::Dependencies& real);

    /// Ends the recording within or between two inputs: a crash is simulated.
    void Stop();

    /// Running timers of the core, with the time at which each is due.
    [[nodiscard]] const std::map<AcsdTimer, Core::SteadyTime>& GetTimers() const noexcept;

    void BeginInput(const CoreInput& input) override;
    void EndInput() override;
    [[nodiscard]] Planning::RobotEvent Watch(const std::string& robotID, const Planning::RobotEvent& event) override;

private:
    void Emit(CoreRecord record) const;
    void Emit(std::string_view kind) const;
    void FlushDrawn();

    [[nodiscard]] Core::Now GetNow() const override;
    [[nodiscard]] std::uint64_t GetNext() override;

    void Store(const Planning::StoreBatch& batch) override;
    void CheckStore() override;
    void CommandRobot(const Planning::CommandRobot& command) override;
    void StartTimer(const AcsdTimer& timer, Core::Duration delay) override;
    void CancelTimer(const AcsdTimer& timer) override;
    void CancelTimers() override;
    void OnOperatorRefused(const RefusedOffer& refused) override;
    void CloseLinks() override;
    void OnStopped() override;
    void OnStoreTaken(const std::string& reason) override;
    void ObserveCommit(Core::Duration duration) override;
    void ObserveAckWait(Core::Duration wait) override;

    [[nodiscard]] bool IsRegistered() const override;
    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request) override;
    void ReplayDone() override;
    void SendStatus(const Protocol::AcsPayload& status) override;
    void SendPosition(const Protocol::RobotPositionUpdate& positions) override;
    void Answer(
        Protocol::EAcsCommand command,
        std::string_view transactionID,
        Protocol::EAckResult result,
        std::string_view message,
        const Protocol::AckPayload& payload) override;
    void SetSiteOffset(std::chrono::minutes offset) override;
};

} // namespace ACS::Acsd
