#include "robots/ArmJobEvidence.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <charconv>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// How often a counter was raised.
std::int64_t CountSteps(std::int64_t before, std::int64_t after)
{
    return static_cast<std::uint32_t>(after) - static_cast<std::uint32_t>(before);
}

std::int64_t CountEnds(const ArmCounters& before, const ArmCounters& after)
{
    return CountSteps(before.finished, after.finished) + CountSteps(before.failed, after.failed);
}

/// Counters are raised, and wrap around: anything else is the work of a restart.
bool HasFallen(std::int64_t before, std::int64_t after)
{
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(CountSteps(before, after))) < 0;
}

/// Any of them.
bool HasFallen(const ArmCounters& before, const ArmCounters& after)
{
    return HasFallen(before.started, after.started) || HasFallen(before.finished, after.finished)
        || HasFallen(before.failed, after.failed);
}

/// The three numbers of MakeProgressToken.
std::optional<ArmCounters> ReadTokenOrNull(std::string_view token)
{
    std::array<std::int64_t, 3> numbers{};
    const char* begin = token.data();
    const char* const end = begin + token.size();
    for (std::int64_t& number : numbers)
    {
        const auto [rest, error] = std::from_chars(begin, end, number);
        if (error != std::errc())
        {
            return std::nullopt;
        }
        begin = rest == end ? rest : rest + 1;
    }
    return begin == end ? std::optional(ArmCounters{numbers[0], numbers[1], numbers[2]}) : std::nullopt;
}

} // namespace

ArmJobEvidence::EChange ArmJobEvidence::Update(const ArmSample& sample)
{
    const std::optional<ArmSample> before = std::exchange(_latest, sample);
    if (before.has_value() && HasFallen(before->counters, sample.counters))
    {
        return EChange::Fallen;
    }
    return before.has_value() && before->counters == sample.counters ? EChange::None : EChange::Changed;
}

std::string ArmJobEvidence::MakeProgressToken() const
{
    if (!_latest.has_value())
    {
        return {};
    }
    const ArmCounters& counters = _latest->counters;
    return fmt::format("{} {} {}", counters.started, counters.finished, counters.failed);
}

void ArmJobEvidence::Begin(std::int32_t jobNumber)
{
    _base = _latest.value_or(ArmSample{}).counters;
    _jobNumber = jobNumber;
    _otherSamples = 0;
}

tl::expected<bool, std::string> ArmJobEvidence::Recover(std::string_view token, std::int32_t jobNumber)
{
    assert(_latest.has_value());
    const ArmCounters now = _latest.value_or(ArmSample{}).counters;
    const std::optional<ArmCounters> baseOrNull = ReadTokenOrNull(token);
    if (!baseOrNull.has_value())
    {
        return tl::unexpected<std::string>("the arm's counters of before the job are not known");
    }
    if (IsZero())
    {
        return tl::unexpected<std::string>("all of the arm's counters are 0, as after a restart of its controller");
    }
    const std::int64_t begun = CountSteps(baseOrNull->started, now.started);
    const std::int64_t ended = CountEnds(*baseOrNull, now);
    if (HasFallen(*baseOrNull, now) || begun > 1 || ended > begun)
    {
        return tl::unexpected<std::string>("the arm's counters have fallen, or more than this one program has run");
    }
    _base = *baseOrNull;
    _jobNumber = jobNumber;
    _otherSamples = 0;
    if (begun != 0 && IsEchoExpected() && !IsEchoed())
    {
        return tl::unexpected(fmt::format("another program of the arm has run: {}", DescribeEcho()));
    }
    return begun != 0;
}

ArmProof ArmJobEvidence::Evaluate()
{
    if (IsUnchanged())
    {
        _otherSamples = 0;
        return {};
    }
    if (HasOtherRun())
    {
        ++_otherSamples;
        return {false, _otherSamples < SAMPLES_OF_OTHER ? ArmProof::EOutcome::Open : ArmProof::EOutcome::OtherProgram};
    }
    _otherSamples = 0;
    const ArmCounters& counters = _latest->counters;
    const bool bBegun = counters.started != _base.started;
    if (counters.failed != _base.failed)
    {
        return {bBegun, ArmProof::EOutcome::Failed};
    }
    return {bBegun, counters.finished != _base.finished ? ArmProof::EOutcome::Finished : ArmProof::EOutcome::Open};
}

bool ArmJobEvidence::IsUnchanged() const
{
    return !_latest.has_value() || _latest->counters == _base;
}

bool ArmJobEvidence::IsZero() const
{
    return _latest.has_value() && _latest->counters == ArmCounters{};
}

bool ArmJobEvidence::IsEchoExpected() const
{
    return _jobNumber != 0 && _latest.has_value() && _latest->echo.has_value();
}

bool ArmJobEvidence::IsEchoed() const
{
    return IsEchoExpected() && _latest->echo == std::int64_t{_jobNumber};
}

/// Without an echo the program of an earlier job may end after this one was commanded: it was not begun since.
bool ArmJobEvidence::HasOtherRun() const
{
    if (IsEchoExpected())
    {
        return !IsEchoed();
    }
    const ArmCounters& now = _latest->counters;
    return CountEnds(_base, now) > CountSteps(_base.started, now.started);
}

std::string ArmJobEvidence::DescribeEcho() const
{
    if (!IsEchoExpected())
    {
        return "the counters show more ends than begins since the job was sent";
    }
    return fmt::format(
        "this job has number {}, the last program echoed {}",
        _jobNumber,
        _latest.value_or(ArmSample{}).echo.value_or(0));
}

} // namespace ACS::Acsd
