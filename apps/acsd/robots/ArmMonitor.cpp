#include "robots/ArmMonitor.hpp"

#include "robots/ArmTimers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Acsd
{

using ArmViews::ArmView;
using ArmViews::Counters;
using ArmViews::Effect;
using ArmViews::Probe;
using ArmViews::Relays;
using ArmViews::Verification;

namespace
{

using namespace std::chrono_literals;
using Planning::AdapterActions;
using Planning::RobotError;

constexpr std::chrono::milliseconds MOTOR_PERIOD = 200ms;

constexpr std::string_view MOTOR_ON_URL = "/project/robot/motor_on";

constexpr std::string_view ERROR_MOTOR = "ARM-motorOff";
constexpr std::string_view ERROR_MONITOR = "ARM-monitorRefused";
constexpr std::string_view ERROR_COUNTERS = "ARM-countersMissing";

RobotError MakeHeavy(std::string_view errorCode, std::string message)
{
    return {std::string(errorCode), Planning::EAlarmLevel::Heavy, std::move(message)};
}

Core::JsonText MakeRangeArgs(std::uint32_t firstByte, std::size_t words)
{
    return Core::JsonText::FromTrusted(fmt::format(R"({{"st":{},"len":{}}})", firstByte, words));
}

} // namespace

ArmMonitor::ArmMonitor(ArmOptions options, RobotOutputs& outputs, ArmControls& controls)
    : _options(std::move(options)),
      _outputs(outputs),
      _controls(controls)
{
}

void ArmMonitor::Monitor(
    std::string_view url,
    std::chrono::milliseconds period,
    std::optional<Core::JsonText> argsOrNull)
{
    OpenStream::MonitorRequest monitor;
    monitor.url = url;
    monitor.period = period;
    monitor.args = std::move(argsOrNull);
    ++_requestNumber;
    _outputs.armRequests.emplace_back(std::move(monitor));
}

void ArmMonitor::MonitorMotor()
{
    Monitor(MOTOR_STATE_URL, MOTOR_PERIOD, std::nullopt);
}

/// Counters arrive after up to one period.
void ArmMonitor::StartRetryTimer(AdapterActions& out) const
{
    const std::chrono::milliseconds delay = _link == ELink::MotorOff
        ? ArmTimers::RETRY_DELAY
        : ArmTimers::AddPeriods(ArmTimers::RETRY_DELAY, _options.period);
    out.emplace_back(Planning::StartAdapterTimer{ArmTimers::RETRY, delay});
}

void ArmMonitor::SwitchMotorOn()
{
    _controls.Send(EArmControl::SwitchMotorOn, MOTOR_ON_URL, "{}");
}

std::size_t ArmMonitor::GetWordCount() const
{
    return std::max(
               {_options.startedIndex, _options.finishedIndex, _options.failedIndex, _options.echoIndex.value_or(0)})
        + 1;
}

void ArmMonitor::WatchCounters(ArmView view)
{
    Monitor(_options.monitorURL, _options.period, MakeRangeArgs(_options.firstByte, GetWordCount()));
    _bRelaysLate = _bRelaysLate || IsReadingRelays();
    _view = std::move(view);
}

void ArmMonitor::WatchCounters()
{
    WatchCounters(Counters{});
}

void ArmMonitor::VerifyCounters()
{
    WatchCounters(Verification{});
}

void ArmMonitor::WatchMotor(AdapterActions& out)
{
    _motorRefusal.clear();
    _link = ELink::MotorOff;
    _view = Counters{};
    MonitorMotor();
    SwitchMotorOn();
    StartRetryTimer(out);
}

void ArmMonitor::OnLost(AdapterActions& out)
{
    for (const Planning::AdapterTimerID timer : {ArmTimers::RETRY, ArmTimers::PROBE, ArmTimers::EFFECT})
    {
        out.emplace_back(Planning::CancelAdapterTimer{timer});
    }
    _link = ELink::Lost;
    _view = Counters{};
    _trouble.reset();
    _bMonitorRefused = false;
    _bRelaysLate = false;
    _bMotorHidden = false;
    _bGeneralHidden = false;
    _unshownEffects = 0;
    _silence = {};
}

ArmFact ArmMonitor::OnSample(const Core::JsonText& json, AdapterActions& out)
{
    switch (_link)
    {
        case ELink::MotorOff:
            if (ReadMotorOnOrNull(json).value_or(false))
            {
                _link = ELink::Counting;
                WatchCounters();
                StartRetryTimer(out);
            }
            return {};
        case ELink::Counting:
        case ELink::Ready:
            return HandleSample(json, out);
        case ELink::Lost:
        default:
            return {};
    }
}

/// A late sample of the counters may arrive after MONITOR has been switched. Samples of relays have the same form: until
/// the MONITOR of a range is accepted, a sample can be of this range, of the range before, or of the counters.
ArmFact ArmMonitor::HandleSample(const Core::JsonText& json, AdapterActions& out)
{
    if (const Relays* const relaysOrNull = std::get_if<Relays>(&_view))
    {
        return relaysOrNull->bAccepted ? HandleRelays(json) : ArmFact();
    }
    if (Effect* const effectOrNull = std::get_if<Effect>(&_view))
    {
        if (const std::optional<GeneralState> stateOrNull = ReadGeneralStateOrNull(json); stateOrNull.has_value())
        {
            effectOrNull->stateOrNull = stateOrNull;
            return ArmEffectShown{*stateOrNull};
        }
    }
    ArmFact probed = HandleProbe(json);
    return std::holds_alternative<std::monostate>(probed) ? HandleCounters(json, out) : probed;
}

ArmFact ArmMonitor::HandleProbe(const Core::JsonText& json)
{
    const Probe* const probeOrNull = std::get_if<Probe>(&_view);
    if (probeOrNull == nullptr)
    {
        return {};
    }
    const EArmProbe kind = probeOrNull->kind;
    std::optional<bool> bOn;
    std::optional<std::int64_t> programOrNull;
    if (kind == EArmProbe::Motor)
    {
        bOn = ReadMotorOnOrNull(json);
    }
    else if (const std::optional<GeneralState> stateOrNull = ReadGeneralStateOrNull(json); stateOrNull.has_value())
    {
        bOn = stateOrNull->bPlaying;
        programOrNull = stateOrNull->program;
    }
    if (!bOn.has_value())
    {
        return {};
    }
    _view = Counters{};
    return ArmProbed{kind, bOn, programOrNull};
}

ArmFact ArmMonitor::HandleRelays(const Core::JsonText& json)
{
    Relays& relays = std::get<Relays>(_view);
    std::optional<std::vector<std::int64_t>> words = ReadRelayWordsOrNull(json);
    const ArmRelayRange& range = relays.ranges[relays.read.size()];
    if (!words.has_value() || words->size() < range.words)
    {
        return {};
    }
    relays.read.push_back({range, std::move(*words)});
    if (relays.read.size() < relays.ranges.size())
    {
        MonitorRange();
        return {};
    }
    relays.bAccepted = relays.ranges.size() == 1; // several ranges are requested again
    return ArmRelaysRead{std::exchange(relays.read, {})};
}

/// Requests the next range.
void ArmMonitor::MonitorRange()
{
    Relays& relays = std::get<Relays>(_view);
    const ArmRelayRange& range = relays.ranges[relays.read.size()];
    Monitor(range.url, std::min(_options.period, LONGEST_READ_PERIOD), MakeRangeArgs(range.firstByte, range.words));
    relays.bAccepted = false;
}

void ArmMonitor::ReadRelays(std::vector<ArmRelayRange> ranges)
{
    _view = Relays{std::move(ranges), {}, false};
    MonitorRange();
}

/// A single range is sampled again without a request.
void ArmMonitor::RepeatRelays()
{
    const Relays* const relaysOrNull = std::get_if<Relays>(&_view);
    if (relaysOrNull != nullptr && relaysOrNull->ranges.size() > 1)
    {
        MonitorRange();
    }
}

std::optional<ArmSample> ArmMonitor::ReadSampleOrNull(const Core::JsonText& json) const
{
    const std::optional<std::vector<std::int64_t>> words = ReadRelayWordsOrNull(json);
    if (!words.has_value() || words->size() < GetWordCount())
    {
        return std::nullopt; // a late sample of the previous MONITOR, or the controller lacks these relays
    }
    ArmSample sample;
    sample.counters = {
        (*words)[_options.startedIndex],
        (*words)[_options.finishedIndex],
        (*words)[_options.failedIndex]};
    if (_options.echoIndex.has_value())
    {
        sample.echo = (*words)[*_options.echoIndex];
    }
    return sample;
}

ArmFact ArmMonitor::HandleCounters(const Core::JsonText& json, AdapterActions& out)
{
    const std::optional<ArmSample> sampleOrNull = ReadSampleOrNull(json);
    if (!sampleOrNull.has_value() || _bRelaysLate)
    {
        return {};
    }
    _bCounted = true;
    const bool bFirst = std::exchange(_link, ELink::Ready) != ELink::Ready;
    if (bFirst)
    {
        _trouble.reset();
        out.emplace_back(Planning::CancelAdapterTimer{ArmTimers::RETRY});
        StartProbeTimer(out);
    }
    const Verification* const verificationOrNull = std::get_if<Verification>(&_view);
    const bool bVerifies = verificationOrNull != nullptr && verificationOrNull->bAccepted;
    const std::optional<GeneralState> stateOrNull = bVerifies ? verificationOrNull->stateOrNull : std::nullopt;
    if (bVerifies || std::holds_alternative<Counters>(_view))
    {
        _view = Counters{true};
    }
    return ArmCounted{*sampleOrNull, bFirst, bVerifies, stateOrNull};
}

void ArmMonitor::OnAccepted(std::uint64_t requestNumber)
{
    if (requestNumber != _requestNumber)
    {
        return; // another MONITOR has been requested since
    }
    _bRelaysLate = false;
    if (Verification* const verificationOrNull = std::get_if<Verification>(&_view))
    {
        verificationOrNull->bAccepted = true;
    }
    else if (Probe* const probeOrNull = std::get_if<Probe>(&_view))
    {
        probeOrNull->bAccepted = true;
    }
    else if (Relays* const relaysOrNull = std::get_if<Relays>(&_view))
    {
        relaysOrNull->bAccepted = true;
    }
}

ArmFact ArmMonitor::OnRefused(const OpenStream::ClientMonitorRefused& refused, AdapterActions& out)
{
    const std::string reason = fmt::format(
        "the arm's controller refuses the MONITOR of {}: {} {}",
        refused.url,
        refused.error.codeText,
        refused.error.message);
    if (std::holds_alternative<Effect>(_view) && refused.url == GENERAL_URL)
    {
        _bGeneralHidden = true;
        VerifyCounters();
        return {};
    }
    if (const Probe* const probeOrNull = std::get_if<Probe>(&_view);
        probeOrNull != nullptr && refused.url == GetProbeURL(probeOrNull->kind))
    {
        return AbandonProbe(true);
    }
    if (const Relays* const relaysOrNull = std::get_if<Relays>(&_view);
        relaysOrNull != nullptr && refused.url == relaysOrNull->ranges[relaysOrNull->read.size()].url)
    {
        return ArmRelaysRefused{reason};
    }
    const std::string_view wanted = _link == ELink::MotorOff ? MOTOR_STATE_URL : std::string_view(_options.monitorURL);
    if (_link == ELink::Lost || refused.url != wanted)
    {
        return {}; // another MONITOR has replaced it
    }
    if (_link == ELink::Ready)
    {
        _link = ELink::Counting;
    }
    _bMonitorRefused = true;
    _trouble = MakeHeavy(ERROR_MONITOR, fmt::format("Counters or motor unknown: {}. Retrying in 5 s.", reason));
    StartRetryTimer(out);
    return {};
}

/// The motor's state shows only whether it is on. The refusal has the reason why it is not.
void ArmMonitor::OnMotorSettled(const ArmSettlement& settlement)
{
    const bool bRefused = settlement.outcome == OpenStream::EControlOutcome::Refused;
    _motorRefusal = bRefused ? settlement.refusal.reason : std::string();
}

bool ArmMonitor::TryHandleFault(const std::string& reason)
{
    if (_link != ELink::MotorOff)
    {
        return false;
    }
    _motorRefusal = reason;
    return true;
}

/// The expected samples have not arrived: reports that and requests them again.
bool ArmMonitor::TryRetry(AdapterActions& out)
{
    if (_link != ELink::MotorOff && _link != ELink::Counting)
    {
        return false;
    }
    if (!std::holds_alternative<Counters>(_view) && !std::holds_alternative<Verification>(_view))
    {
        StartRetryTimer(out); // the counters are requested again when the effect, the probe or the relays are settled
        return true;
    }
    const bool bRefused = std::exchange(_bMonitorRefused, false);
    if (_link == ELink::MotorOff)
    {
        if (bRefused)
        {
            MonitorMotor();
        }
        else
        {
            ReportMotorOff();
        }
        SwitchMotorOn();
    }
    else
    {
        const Verification* const verificationOrNull = std::get_if<Verification>(&_view);
        WatchCounters(
            verificationOrNull == nullptr ? ArmView(Counters{})
                                          : ArmView(Verification{false, verificationOrNull->stateOrNull}));
        if (!bRefused)
        {
            _trouble = MakeHeavy(
                ERROR_COUNTERS,
                fmt::format(
                    "MONITOR of {} shows no counters of the arm's programs. Check whether the controller has these "
                    "relays. Check arm.monitor_url, arm.monitor_start and arm.counter_… in the configuration.",
                    _options.monitorURL));
        }
    }
    StartRetryTimer(out);
    return true;
}

void ArmMonitor::ReportMotorOff()
{
    _trouble = MakeHeavy(
        ERROR_MOTOR,
        _motorRefusal.empty() ? std::string("The arm's motor is off. It is being switched on.")
                              : fmt::format("The arm's motor is off: {}", _motorRefusal));
}

bool ArmMonitor::IsLost() const noexcept
{
    return _link == ELink::Lost;
}

bool ArmMonitor::IsReady() const noexcept
{
    return _link == ELink::Ready;
}

bool ArmMonitor::IsIdle() const noexcept
{
    return IsReady() && (std::holds_alternative<Counters>(_view) || IsProbing());
}

bool ArmMonitor::IsProbing() const noexcept
{
    return std::holds_alternative<Probe>(_view);
}

bool ArmMonitor::IsReadingRelays() const noexcept
{
    return std::holds_alternative<Relays>(_view);
}

bool ArmMonitor::IsHidden(EArmProbe probe) const noexcept
{
    return probe == EArmProbe::Motor ? _bMotorHidden : _bGeneralHidden;
}

const std::optional<RobotError>& ArmMonitor::GetTroubleOrNull() const noexcept
{
    return _trouble;
}

} // namespace ACS::Acsd
