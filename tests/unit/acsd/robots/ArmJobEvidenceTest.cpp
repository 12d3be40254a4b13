#include "robots/ArmJobEvidence.hpp"

#include "Catch.hpp"

namespace ACS::Acsd::Test
{

namespace
{

using EOutcome = ArmProof::EOutcome;

ArmSample MakeSample(std::int64_t started, std::int64_t finished, std::int64_t failed, std::int64_t echo)
{
    return {{started, finished, failed}, echo};
}

/// The job with number 4711 is commanded.
ArmJobEvidence MakeBegun()
{
    ArmJobEvidence evidence;
    evidence.Update(MakeSample(5, 5, 0, 17));
    evidence.Begin(4711);
    return evidence;
}

} // namespace

TEST_CASE("The progress token is the three counters, and empty before the first sample")
{
    ArmJobEvidence evidence;
    CHECK(evidence.MakeProgressToken().empty());
    CHECK(evidence.Update(MakeSample(5, 4, 1, 17)) == ArmJobEvidence::EChange::Changed);
    CHECK(evidence.MakeProgressToken() == "5 4 1");
    CHECK(evidence.Update(MakeSample(5, 4, 1, 18)) == ArmJobEvidence::EChange::None);
    CHECK(evidence.Update(MakeSample(6, 4, 1, 18)) == ArmJobEvidence::EChange::Changed);
    CHECK(evidence.Update(MakeSample(0, 0, 0, 0)) == ArmJobEvidence::EChange::Fallen);
}

TEST_CASE("Counters that wrap around have not fallen")
{
    ArmJobEvidence evidence;
    evidence.Update(MakeSample(2'147'483'647, 0, 0, 0));
    CHECK(evidence.Update(MakeSample(-2'147'483'648, 0, 0, 0)) == ArmJobEvidence::EChange::Changed);
}

TEST_CASE("Counters prove a job's begin and end under its own number")
{
    ArmJobEvidence evidence = MakeBegun();
    CHECK(evidence.Evaluate() == ArmProof{});
    CHECK(evidence.IsUnchanged());
    evidence.Update(MakeSample(5, 5, 0, 4711));
    CHECK(evidence.IsEchoed());
    CHECK(evidence.Evaluate() == ArmProof{});
    evidence.Update(MakeSample(6, 5, 0, 4711));
    CHECK_FALSE(evidence.IsUnchanged());
    CHECK(evidence.Evaluate() == ArmProof{true, EOutcome::Open});
    evidence.Update(MakeSample(6, 6, 0, 4711));
    CHECK(evidence.Evaluate() == ArmProof{true, EOutcome::Finished});
    evidence.Update(MakeSample(6, 6, 1, 4711));
    CHECK(evidence.Evaluate() == ArmProof{true, EOutcome::Failed});
}

TEST_CASE("Counters under another number prove that another program ran, from the second sample on")
{
    ArmJobEvidence evidence = MakeBegun();
    evidence.Update(MakeSample(6, 6, 0, 17));
    CHECK(evidence.Evaluate() == ArmProof{false, EOutcome::Open});
    CHECK(evidence.Evaluate() == ArmProof{false, EOutcome::OtherProgram});
    CHECK(evidence.DescribeEcho().find("4711") != std::string::npos);
}

TEST_CASE("Without an echo, or without a number, any change counts for the job")
{
    ArmJobEvidence silent;
    silent.Update({{5, 5, 0}, std::nullopt});
    silent.Begin(4711);
    silent.Update({{6, 6, 0}, std::nullopt});
    CHECK(silent.Evaluate() == ArmProof{true, EOutcome::Finished});
    CHECK_FALSE(silent.IsEchoed());

    ArmJobEvidence older;
    older.Update(MakeSample(5, 5, 0, 17));
    older.Begin(0);
    older.Update(MakeSample(6, 5, 1, 17));
    CHECK(older.Evaluate() == ArmProof{true, EOutcome::Failed});
}

TEST_CASE("Without an echo, more ends than begins prove that another program has ended, from the second sample on")
{
    ArmJobEvidence evidence;
    evidence.Update({{6, 5, 0}, std::nullopt}); // the program of an earlier job runs
    evidence.Begin(4711);
    const ArmCounters ended = GENERATE(ArmCounters{6, 6, 0}, ArmCounters{6, 5, 1}, ArmCounters{7, 6, 1});
    evidence.Update({ended, std::nullopt});
    CHECK(evidence.Evaluate() == ArmProof{false, EOutcome::Open});
    SECTION("it was not this job's")
    {
        evidence.Update({ended, std::nullopt});
        CHECK(evidence.Evaluate() == ArmProof{false, EOutcome::OtherProgram});
        CHECK(evidence.DescribeEcho().find("echoed") == std::string::npos);
    }
    SECTION("the words of the first sample were not of one moment")
    {
        evidence.Update({{8, 6, 0}, std::nullopt});
        CHECK(evidence.Evaluate() == ArmProof{true, EOutcome::Finished});
    }
}

TEST_CASE("Under the job's own number its end counts, whatever was counted of its begin")
{
    ArmJobEvidence evidence = MakeBegun();
    evidence.Update(MakeSample(5, 6, 0, 4711));
    CHECK(evidence.Evaluate() == ArmProof{false, EOutcome::Finished});
}

TEST_CASE("After a restart one program more under the job's number is the job's; anything else proves nothing")
{
    ArmJobEvidence evidence;
    evidence.Update(MakeSample(6, 5, 0, 4711));
    CHECK(evidence.Recover("5 5 0", 4711) == true);
    CHECK(evidence.Evaluate() == ArmProof{true, EOutcome::Open});
    CHECK(evidence.Recover("6 5 0", 4711) == false);
    CHECK(evidence.Recover("5 5 0", 0) == true);

    CHECK_FALSE(evidence.Recover("5 5 0", 42).has_value());
    CHECK_FALSE(evidence.Recover("4 5 0", 4711).has_value());
    CHECK_FALSE(evidence.Recover("7 5 0", 4711).has_value());
    CHECK_FALSE(evidence.Recover("6 4 0", 4711).has_value());
    for (const char* token : {"", "5 5", "5 5 x", "5 5 0 1"})
    {
        INFO(token);
        CHECK_FALSE(evidence.Recover(token, 4711).has_value());
    }
    evidence.Update(MakeSample(0, 0, 0, 0));
    CHECK_FALSE(evidence.Recover("0 0 0", 4711).has_value());
}

} // namespace ACS::Acsd::Test
