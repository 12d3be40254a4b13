#include "replay/CoreReplay.hpp"

#include "replay/InputCodec.hpp"
#include "replay/JobCheckText.hpp"
#include "replay/OutputText.hpp"
#include "replay/RecordKind.hpp"
#include "replay/RobotEventCodec.hpp"
#include "replay/TimerText.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/IJobCheck.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

std::string DescribeRecord(const CoreRecord& record)
{
    std::string text = record.kind;
    for (const std::string* const part : {&record.robotID, &record.text})
    {
        text += part->empty() ? "" : " ";
        text += *part;
    }
    return text;
}

bool IsSame(const CoreRecord& expected, const CoreRecord& actual)
{
    return expected.bInput == actual.bInput && expected.kind == actual.kind && expected.robotID == actual.robotID
        && expected.text == actual.text;
}

} // namespace

/// Answers as the recorded run's job check did.
class CoreReplay::RecordedCheck final : public Planning::IJobCheck
{
    const CoreReplay& _replay;
    const std::string _robotID;
    mutable std::map<std::string, std::string> _reasons; ///< By job. A later check may accept it.

public:
    RecordedCheck(const CoreReplay& replay, std::string robotID)
        : _replay(replay),
          _robotID(std::move(robotID))
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const Planning::StartJob& job) const override
    {
        const std::string key = EncodeJob(job);
        const CoreRecord* const nextOrNull = _replay.GetNextOrNull();
        if (nextOrNull != nullptr && nextOrNull->kind == JOB_CHECK_KIND)
        {
            const Core::Result<JobRejection> rejection = DecodeRejection(*nextOrNull);
            if (rejection.has_value() && rejection->robotID == _robotID && rejection->job == key)
            {
                _reasons.insert_or_assign(key, rejection->reason);
            }
        }
        const auto found = _reasons.find(key);
        return found == _reasons.end() ? std::nullopt : std::optional(found->second);
    }
};

CoreReplay::CoreReplay(const AcsdConfig& config, RecordSource source, ConfigSource readConfig)
    : _config(config),
      _source(std::move(source)),
      _readConfig(std::move(readConfig)),
      _recorder([this](const CoreRecord& actual) { OnActual(actual); })
{
}

ReplayOutcome CoreReplay::Run()
{
    ReadAhead();
    if (_expected.empty())
    {
        return _outcome;
    }
    ReadAhead(); // the core may draw numbers before its first input
    _now = _expected.front().now;
    _checkedAt = _now.steady;
    _core.emplace(_recorder.Wrap({*this, *this, Core::Logger(), *this, *this}), _config);
    while (!ShouldEnd() && !_expected.empty())
    {
        const CoreRecord& next = _expected.front();
        if (!next.bInput || next.depth > 0)
        {
            _outcome.fault = fmt::format("{}: {} without its input", next.place, next.kind);
            break;
        }
        _now = next.now;
        _input = DescribeRecord(next);
        _outcome.firstOrNull = _outcome.firstOrNull.value_or(_now);
        _outcome.lastOrNull = _now;
        CheckTimers();
        ReadAhead();
        Deliver();
        CheckEnd();
    }
    return _outcome;
}

/// Reads up to the next input that is not nested: a turn has the numbers that are drawn in it.
void CoreReplay::ReadAhead()
{
    while (!_bEnd)
    {
        std::optional<CoreRecord> recordOrNull = _source();
        if (!recordOrNull.has_value())
        {
            _bEnd = true;
            return;
        }
        if (recordOrNull->kind == RANDOM_KIND)
        {
            const std::string& text = recordOrNull->text;
            std::uint64_t number = 0;
            for (const char* at = text.data(); at < text.data() + text.size();)
            {
                constexpr int HEXADECIMAL = 16;
                const auto [end, error] = std::from_chars(at, text.data() + text.size(), number, HEXADECIMAL);
                if (error != std::errc())
                {
                    break;
                }
                _random.push_back(number);
                at = end + 1;
            }
        }
        const bool bOuter = recordOrNull->bInput && recordOrNull->depth == 0;
        _expected.push_back(std::move(*recordOrNull));
        if (bOuter)
        {
            return;
        }
    }
}

bool CoreReplay::ShouldEnd() const
{
    return _outcome.differenceOrNull.has_value() || !_outcome.fault.empty();
}

void CoreReplay::Deliver()
{
    const CoreRecord record = _expected.front(); // it is removed when the core's recorder has seen it
    Core::Result<CoreInput> input = DecodeInput(record);
    if (!input.has_value())
    {
        _outcome.fault = fmt::format("{}: {}", record.place, Core::Describe(input.error()));
        return;
    }
    if (std::holds_alternative<RestoreInput>(*input) != (_outcome.inputs == 0))
    {
        _outcome.fault = fmt::format("{}: the first input must restore the store, and no other one", record.place);
        return;
    }
    const bool bOfRobot = std::holds_alternative<Planning::RobotInput>(*input);
    const bool bOfTimer = std::holds_alternative<AcsdTimer>(*input) && !record.robotID.empty();
    if ((bOfRobot || bOfTimer) && !IsKnown(record.robotID))
    {
        _outcome.fault = fmt::format("{}: the configuration has no robot {}", record.place, record.robotID);
        return;
    }
    if (std::holds_alternative<StoredInput>(*input) && !std::exchange(_bStoring, false))
    {
        _outcome.fault = fmt::format("{}: the end of a transaction that has not begun", record.place);
        return;
    }
    ++_outcome.inputs;
    ++_depth;
    Call(std::move(*input), record);
    --_depth;
}

/// Of an output that has been compared: in the recorded run these came within its call.
void CoreReplay::DeliverNested()
{
    while (!ShouldEnd() && !_expected.empty() && _expected.front().bInput && _expected.front().depth == _depth
           && _depth > 0)
    {
        Deliver();
    }
}

void CoreReplay::Call(CoreInput input, const CoreRecord& record)
{
    std::visit(
        Core::Overloaded{
            [this](RestoreInput& restore) { _core->Restore(std::move(restore.state)); },
            [this](const StartInput&) { _core->Start(); },
            [this](const ReloadInput& reload) {
                const AcsdConfig config = _readConfig(reload.config);
                if (config.errors.empty())
                {
                    _core->Reload(config);
                }
                else
                {
                    _outcome.fault = fmt::format("the reloaded configuration is invalid: {}", config.errors.front());
                }
            },
            [this](const Protocol::SessionEvent& event) { _core->OnSessionEvent(event); },
            [this, &record](const Planning::RobotInput& robot) {
                if (HasJobCheck(record.text))
                {
                    const auto check = std::make_shared<RecordedCheck>(*this, robot.robotID);
                    _core->OnRobotEvent(robot.robotID, Planning::JobCheckChanged{check});
                }
                else
                {
                    _core->OnRobotEvent(robot.robotID, robot.event);
                }
            },
            [this](const AcsdTimer& timer) { _core->OnTimer(timer); },
            [this](const MqttInput& mqtt) { mqtt.bUp ? _core->OnMqttUp() : _core->OnMqttDown(); },
            [this](StoredInput& stored) {
                _core->OnStored(
                    stored.errorOrNull.has_value() ? Core::Result<void>(tl::unexpected(std::move(*stored.errorOrNull)))
                                                   : Core::Result<void>());
            },
            [this](const StoreLostInput& lost) { _core->OnStoreLost(lost.error); },
            [this](const Planning::StoreLog& log) { _core->OnStoreLog(log); },
            [this](OfferInput& offer) {
                static_cast<void>(_core->Offer(std::move(offer.command), std::move(offer.receipt)));
            },
            [this](const LinksClosedInput&) { _core->OnLinksClosed(); },
            [this](const StopInput&) { _core->Stop(); },
            [this](const CloseInput&) {
                _core->Close();
            }},
        input);
}

void CoreReplay::OnActual(const CoreRecord& actual)
{
    if (ShouldEnd() || IsCut(actual))
    {
        return;
    }
    const CoreRecord expected = _expected.front();
    if (!IsSame(expected, actual))
    {
        const bool bNothing = expected.bInput && expected.depth == 0;
        Differ(bNothing ? "no output" : DescribeRecord(expected), DescribeRecord(actual), expected.place);
        return;
    }
    _expected.pop_front();
    _outcome.reports += expected.kind == REPORT_KIND ? 1U : 0U;
    _outcome.commands += expected.kind == COMMAND_KIND ? 1U : 0U;
}

/// Whether the recording ends within the current input, because acsd was ended there, before this record.
bool CoreReplay::IsCut(const CoreRecord& actual) const
{
    const bool bOnlyNumbers = _expected.size() == 1 && _expected.front().kind == RANDOM_KIND;
    return _bEnd && (_bUnknownNumbers || _expected.empty() || (bOnlyNumbers && actual.kind != RANDOM_KIND));
}

void CoreReplay::CheckTimers()
{
    constexpr std::chrono::seconds INTERVAL{10};
    if (_now.steady - _checkedAt < INTERVAL)
    {
        return;
    }
    _checkedAt = _now.steady;
    for (const auto& [timer, due] : _recorder.GetTimers())
    {
        if (_now.steady - due > LATEST_TIMER)
        {
            Differ(
                fmt::format("no timer {}", DescribeTimer(timer)),
                fmt::format("timer {}", EncodeTimer(timer, due)),
                _expected.front().place);
            return;
        }
    }
}

/// After an input that is not nested.
void CoreReplay::CheckEnd()
{
    const bool bNext = !_expected.empty() && _expected.front().bInput && _expected.front().depth == 0;
    if (ShouldEnd() || _expected.empty() || bNext)
    {
        return;
    }
    if (IsCut({}))
    {
        _expected.clear(); // acsd was ended after it had drawn these numbers
        return;
    }
    Differ(DescribeRecord(_expected.front()), "no output", _expected.front().place);
}

void CoreReplay::Differ(std::string expected, std::string actual, const std::string& place)
{
    _outcome.differenceOrNull = ReplayDifference{_now, place, _input, std::move(expected), std::move(actual)};
}

bool CoreReplay::IsKnown(const std::string& robotID) const
{
    return std::ranges::any_of(_config.engine.robots, [&robotID](const Planning::RobotOptions& robot) {
        return robot.robotID.GetText() == robotID;
    });
}

const CoreRecord* CoreReplay::GetNextOrNull() const
{
    return _expected.empty() ? nullptr : &_expected.front();
}

Core::Now CoreReplay::GetNow() const
{
    return _now;
}

/// Numbers beyond the recorded ones belong to a difference that follows, or to the input within which the recording ends.
std::uint64_t CoreReplay::GetNext()
{
    if (_random.empty())
    {
        _bUnknownNumbers = true;
        return 0;
    }
    const std::uint64_t number = _random.front();
    _random.pop_front();
    return number;
}

void CoreReplay::Store(const Planning::StoreBatch& /*batch*/)
{
    _bStoring = true;
    DeliverNested();
}

void CoreReplay::CheckStore()
{
    // The recorded result follows as an input.
}

void CoreReplay::CommandRobot(const Planning::CommandRobot& /*command*/)
{
    DeliverNested();
}

void CoreReplay::StartTimer(const AcsdTimer& /*timer*/, Core::Duration /*delay*/)
{
    // The recorder keeps it.
}

void CoreReplay::CancelTimer(const AcsdTimer& /*timer*/)
{
}

void CoreReplay::CancelTimers()
{
}

void CoreReplay::CloseLinks()
{
    DeliverNested();
}

void CoreReplay::OnStopped()
{
    DeliverNested();
}

void CoreReplay::OnStoreTaken(const std::string& /*reason*/)
{
    DeliverNested();
}

void CoreReplay::ObserveCommit(Core::Duration /*duration*/)
{
}

void CoreReplay::OnOperatorRefused(const RefusedOffer& /*refused*/)
{
}

void CoreReplay::ObserveAckWait(Core::Duration /*wait*/)
{
}

bool CoreReplay::IsRegistered() const
{
    const CoreRecord* const nextOrNull = GetNextOrNull();
    if (nextOrNull != nullptr && (nextOrNull->kind == REGISTERED_KIND || nextOrNull->kind == UNREGISTERED_KIND))
    {
        _bRegistered = nextOrNull->kind == REGISTERED_KIND;
    }
    return _bRegistered;
}

bool CoreReplay::TrySendDurable(const Protocol::AcsRequest& /*request*/)
{
    const CoreRecord* const nextOrNull = GetNextOrNull();
    return nextOrNull == nullptr || nextOrNull->kind != HELD_REPORT_KIND;
}

void CoreReplay::ReplayDone()
{
    DeliverNested();
}

void CoreReplay::SendStatus(const Protocol::AcsPayload& /*status*/)
{
    DeliverNested();
}

void CoreReplay::SendPosition(const Protocol::RobotPositionUpdate& /*positions*/)
{
    DeliverNested();
}

void CoreReplay::Answer(
    Protocol::EAcsCommand /*command*/,
    std::string_view /*transactionID*/,
    Protocol::EAckResult /*result*/,
    std::string_view /*message*/,
    const Protocol::AckPayload& /*payload*/)
{
    DeliverNested();
}

void CoreReplay::SetSiteOffset(std::chrono::minutes /*offset*/)
{
}

} // namespace ACS::Acsd
