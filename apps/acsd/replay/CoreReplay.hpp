#pragma once

#include "AcsdCore.hpp"
#include "config/AcsdConfig.hpp"
#include "replay/CoreRecord.hpp"
#include "replay/CoreRecorder.hpp"
#include "replay/ReplayOutcome.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// Repeats a recorded run in virtual time: gives the inputs of the records to a fresh AcsdCore and compares its outputs with those of
/// the records. Pure.
class CoreReplay final : private IAcsdOutput, private IMcsOutput, private Core::IClock, private Core::IRandom
{
public:
    /// The next record of the run, without its first (BEGIN_KIND); nullopt: there is none.
    using RecordSource = std::function<std::optional<CoreRecord>()>;
    /// The configuration of a text of MakeRecordedConfig.
    using ConfigSource = std::function<AcsdConfig(const std::string& text)>;

    /// A timer that expires later than this after it was due was not started in the recorded run.
    static constexpr std::chrono::seconds LATEST_TIMER{30};

private:
    class RecordedCheck;

    const AcsdConfig& _config;
    RecordSource _source;
    ConfigSource _readConfig;
    std::deque<CoreRecord> _expected;  ///< The rest of the current input, and the next input.
    std::deque<std::uint64_t> _random; ///< Numbers to be drawn in the current input.
    CoreRecorder _recorder;
    std::optional<AcsdCore> _core;
    Core::Now _now;
    Core::SteadyTime _checkedAt; ///< Timers.
    std::size_t _depth = 0;      ///< Number of inputs that have not ended.
    mutable bool _bRegistered = false;
    bool _bStoring = false;        ///< A transaction has begun and not ended.
    bool _bUnknownNumbers = false; ///< More were drawn than recorded.
    bool _bEnd = false;            ///< Of the source.
    std::string _input;            ///< Description of the latest input that is not nested.
    ReplayOutcome _outcome;

public:
    /// The configuration is valid and outlives the replay.
    CoreReplay(const AcsdConfig& config, RecordSource source, ConfigSource readConfig);

    /// Up to the first difference, or to the end of the records. Call it once.
    [[nodiscard]] ReplayOutcome Run();

private:
    void ReadAhead();
    [[nodiscard]] bool ShouldEnd() const;
    void Deliver();
    void DeliverNested();
    void Call(CoreInput input, const CoreRecord& record);
    void OnActual(const CoreRecord& actual);
    [[nodiscard]] bool IsCut(const CoreRecord& actual) const;
    void CheckTimers();
    void CheckEnd();
    void Differ(std::string expected, std::string actual, const std::string& place);
    [[nodiscard]] bool IsKnown(const std::string& robotID) const;
    [[nodiscard]] const CoreRecord* GetNextOrNull() const;

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
