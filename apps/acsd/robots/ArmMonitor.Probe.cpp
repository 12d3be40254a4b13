#include "robots/ArmMonitor.hpp"

#include "robots/ArmTimers.hpp"

#include <algorithm>
#include <utility>

// What MONITOR shows in place of the counters: the effect of a CONTROL, and probes.

namespace ACS::Acsd
{

using ArmViews::Counters;
using ArmViews::Effect;
using ArmViews::Probe;
using ArmViews::Verification;

namespace
{

using namespace std::chrono_literals;
using Planning::AdapterActions;

constexpr std::chrono::milliseconds PROBE_INTERVAL = 1s;
/// A probe costs two samples, so a slow MONITOR is probed less often.
constexpr int PROBE_PERIODS = 20;
/// Maximum time for the general state to show the effect of a CONTROL. After it a CONTROL counts as executed if no state
/// was shown.
constexpr std::chrono::milliseconds EFFECT_LIMIT = 2s;
/// After this number of CONTROLs in a row without any state, the controller is assumed not to show its state at all.
constexpr std::size_t MOST_UNSHOWN = 3;

} // namespace

/// The effect was not shown, but nothing was refused either.
void ArmMonitor::OnEffectTimer()
{
    if (const Effect* const effectOrNull = std::get_if<Effect>(&_view))
    {
        _unshownEffects = effectOrNull->stateOrNull.has_value() ? 0 : _unshownEffects + 1;
        WatchCounters(Verification{false, effectOrNull->stateOrNull});
    }
}

void ArmMonitor::VerifyEffect(AdapterActions& out)
{
    if (_bGeneralHidden || _unshownEffects >= MOST_UNSHOWN)
    {
        VerifyCounters();
        return;
    }
    _view = Effect{};
    Monitor(GENERAL_URL, std::min(_options.period, LONGEST_READ_PERIOD), std::nullopt);
    out.emplace_back(Planning::StartAdapterTimer{ArmTimers::EFFECT, EFFECT_LIMIT});
}

void ArmMonitor::EndEffect(AdapterActions& out)
{
    out.emplace_back(Planning::CancelAdapterTimer{ArmTimers::EFFECT});
    OnEffectTimer();
}

ArmFact ArmMonitor::OnProbeTimer(std::optional<EArmProbe> wantedOrNull, AdapterActions& out)
{
    StartProbeTimer(out);
    if (const Probe* const probeOrNull = std::get_if<Probe>(&_view))
    {
        return AbandonProbe(probeOrNull->bAccepted);
    }
    if (_link != ELink::Ready)
    {
        return {};
    }
    if (HasLostCounters())
    {
        _link = ELink::Counting;
        static_cast<void>(TryRetry(out));
        return {};
    }
    const Counters* const countersOrNull = std::get_if<Counters>(&_view);
    const bool bFree = countersOrNull != nullptr && countersOrNull->bFresh && _controls.IsIdle();
    if (bFree && wantedOrNull.has_value() && !IsHidden(*wantedOrNull))
    {
        BeginProbe(*wantedOrNull, out);
    }
    return {};
}

/// Call once for each probe timer. A MONITOR may stop to show the counters, for example when the relays were removed.
bool ArmMonitor::HasLostCounters()
{
    const bool bShown = std::holds_alternative<Counters>(_view) || std::holds_alternative<Verification>(_view);
    const bool bSilent = bShown && !std::exchange(_bCounted, false);
    _silence = bSilent ? _silence + GetProbeDelay() : std::chrono::milliseconds(0);
    return _silence >= ArmTimers::RETRY_DELAY;
}

std::chrono::milliseconds ArmMonitor::GetProbeDelay() const
{
    return std::max(PROBE_INTERVAL, PROBE_PERIODS * _options.period);
}

void ArmMonitor::StartProbeTimer(AdapterActions& out) const
{
    out.emplace_back(Planning::StartAdapterTimer{ArmTimers::PROBE, GetProbeDelay()});
}

/// The probe may be answered during the whole interval.
void ArmMonitor::BeginProbe(EArmProbe probe, AdapterActions& out)
{
    StartProbeTimer(out);
    _view = Probe{probe, false};
    Monitor(GetProbeURL(probe), std::min(_options.period, LONGEST_READ_PERIOD), std::nullopt);
}

/// A probe that was accepted and not answered, or refused, is not supported by this controller.
ArmFact ArmMonitor::AbandonProbe(bool bHidden)
{
    const EArmProbe kind = std::get<Probe>(_view).kind;
    bool& bKnownHidden = kind == EArmProbe::Motor ? _bMotorHidden : _bGeneralHidden;
    bKnownHidden = bKnownHidden || bHidden;
    _view = Counters{};
    return ArmProbed{kind, std::nullopt, std::nullopt};
}

std::string_view ArmMonitor::GetProbeURL(EArmProbe probe)
{
    return probe == EArmProbe::Motor ? MOTOR_STATE_URL : GENERAL_URL;
}

} // namespace ACS::Acsd
