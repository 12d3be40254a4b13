#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The words that an arm's programs raise; they wrap around.
struct ArmCounters
{
    std::int64_t started = 0;
    std::int64_t finished = 0;
    std::int64_t failed = 0;

    bool operator==(const ArmCounters&) const = default;
};

/// One sample of the words that programs write.
struct ArmSample
{
    ArmCounters counters;
    std::optional<std::int64_t> echo; ///< Absent where programs cannot echo.
};

/// What the counters prove of the present job.
struct ArmProof
{
    enum class EOutcome : std::uint8_t
    {
        Open,
        Finished,
        Failed,
        OtherProgram, ///< A program ran that was not started for this job.
    };

    bool bBegun = false;
    EOutcome outcome = EOutcome::Open;

    bool operator==(const ArmProof&) const = default;
};

/// What the words that an arm's programs write prove of a job. Where programs echo the number of their job, only changes
/// under the job's own number count for it; otherwise any change does, except the end of a program that was begun before.
class ArmJobEvidence
{
public:
    enum class EChange : std::uint8_t
    {
        None,
        Changed, ///< Or the first sample.
        Fallen,  ///< As after a restart of the controller.
    };

private:
    /// Samples in a row that show another program: the words of one sample need not be of one moment.
    static constexpr std::size_t SAMPLES_OF_OTHER = 2;

    std::optional<ArmSample> _latest;
    ArmCounters _base;           ///< Of the moment when the job was commanded.
    std::int32_t _jobNumber = 0; ///< 0: unknown.
    std::size_t _otherSamples = 0;

public:
    EChange Update(const ArmSample& sample);

    /// "5 5 0" for RestartEvidence::progressToken; empty before the first sample.
    [[nodiscard]] std::string MakeProgressToken() const;

    /// The job is commanded now. Number 0: its program cannot echo one.
    void Begin(std::int32_t jobNumber);

    /// The job was commanded before a restart, with the token of that moment. Whether its program has begun, or why the
    /// counters prove nothing. Not before the first sample.
    [[nodiscard]] tl::expected<bool, std::string> Recover(std::string_view token, std::int32_t jobNumber);

    /// To be called once for each sample while the job's program may have begun.
    [[nodiscard]] ArmProof Evaluate();

    /// No program has raised a counter since the job was commanded.
    [[nodiscard]] bool IsUnchanged() const;

    /// All counters are 0, as after a restart of the controller.
    [[nodiscard]] bool IsZero() const;

    /// The job's program has surely begun, even where it has raised no counter yet.
    [[nodiscard]] bool IsEchoed() const;

    /// For people: what shows that another program has run.
    [[nodiscard]] std::string DescribeEcho() const;

private:
    [[nodiscard]] bool IsEchoExpected() const;
    [[nodiscard]] bool HasOtherRun() const;
};

} // namespace ACS::Acsd
