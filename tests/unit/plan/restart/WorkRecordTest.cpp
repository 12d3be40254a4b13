#include "restart/WorkRecord.hpp"

#include "Catch.hpp"
#include "SeededRandom.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

RobotWorkChanged MakeStored(const std::string& commandID, const std::string& progressToken = {})
{
    RobotWorkChanged work;
    work.robotID = "LR01";
    work.commandID = commandID;
    work.progressToken = progressToken;
    return work;
}

StateChanged MakeShown(std::optional<std::string> commandIDOrNull, const std::string& progressToken = {})
{
    StateChanged state;
    state.restartEvidence.commandID = std::move(commandIDOrNull);
    state.restartEvidence.progressToken = progressToken;
    return state;
}

/// With a heavy error: it gets no work.
StateChanged MakeFaulty(std::optional<std::string> commandIDOrNull, const std::string& progressToken = {})
{
    StateChanged state = MakeShown(std::move(commandIDOrNull), progressToken);
    state.errors.push_back({"ARM-motorOff", EAlarmLevel::Heavy, "The arm's motor is off."});
    return state;
}

/// Whether a robot that shows this after a restart may have done more than was stored.
bool IsUnresolvedAfter(const RobotWorkChanged& stored, const StateChanged& state)
{
    WorkRecord record;
    record.Restore(stored);
    CHECK(record.TryCheckEvidence(state, true));
    CHECK_FALSE(record.TryCheckEvidence(MakeShown("another"), true)); // only the first state counts
    return record.IsUnresolved();
}

} // namespace

TEST_CASE("WorkRecord: earlier commands are remembered, the latest first and eight at most")
{
    WorkRecord record;
    for (const char* commandID : {"1", "2", "2", "3", "4", "5", "6", "7", "8", "9", "10"})
    {
        record.AddCommand(commandID);
    }
    CHECK(record.Make("LR01").commandID == "10");
    CHECK(record.GetEarlierIDs() == std::vector<std::string>{"9", "8", "7", "6", "5", "4", "3", "2"});
}

TEST_CASE("WorkRecord: a command that the robot never had is unresolved if the robot shows it after a crash")
{
    WorkRecord record;
    record.AddCommand("drive");
    record.AddCommand("job");
    record.ForgetCommand("job");
    record.ForgetCommand("unknown");
    CHECK_FALSE(IsUnresolvedAfter(record.Make("LR01"), MakeShown("drive")));
    CHECK(IsUnresolvedAfter(record.Make("LR01"), MakeShown("job"))); // commanded again while the store failed
    record.AddCommand("job");
    CHECK(record.Make("LR01").commandID == "job");
    CHECK(record.GetEarlierIDs() == std::vector<std::string>{"drive"});
    record.ForgetCommand("job");
    record.ForgetCommand("drive");
    CHECK(record.Make("LR01").commandID.empty());
}

TEST_CASE("WorkRecord: a job has a number of its own, and a repeated job keeps it")
{
    ACS::Testing::SeededRandom random(1);
    WorkRecord record;
    const std::int32_t first = record.NumberJob(true, random); // there is no number to keep
    CHECK(first > 0);
    CHECK(record.NumberJob(true, random) == first);
    CHECK(record.NumberJob(false, random) != first);
}

TEST_CASE("WorkRecord: a shown command that was not stored makes the next jobs unresolved")
{
    RobotWorkChanged stored = MakeStored("C2");
    stored.earlierIDs = {"C1"};
    CHECK_FALSE(IsUnresolvedAfter(stored, MakeShown("C2")));
    CHECK_FALSE(IsUnresolvedAfter(stored, MakeShown("C1")));
    CHECK_FALSE(IsUnresolvedAfter(stored, MakeShown(std::nullopt))); // robots of this kind show no command
    CHECK(IsUnresolvedAfter(stored, MakeShown("C3")));
    CHECK(IsUnresolvedAfter(stored, MakeShown(""))); // it has lost its commands
}

TEST_CASE("WorkRecord: a robot that never had a command shows none")
{
    RobotWorkChanged stored = MakeStored("C1");
    CHECK_FALSE(IsUnresolvedAfter(stored, MakeShown("")));
    stored.bCommandTaken = true;
    CHECK(IsUnresolvedAfter(stored, MakeShown("")));
}

TEST_CASE("WorkRecord: a progress token proves more than the command, but not of a job that is open")
{
    RobotWorkChanged stored = MakeStored("C1", "7");
    CHECK_FALSE(IsUnresolvedAfter(stored, MakeShown("C9", "7")));
    CHECK(IsUnresolvedAfter(stored, MakeShown("C1", "8")));
    stored.job = StartJob{};
    CHECK_FALSE(IsUnresolvedAfter(stored, MakeShown("C1", "8")));
}

TEST_CASE("WorkRecord: a changed progress token proves nothing while the program of a resolved job may have ended")
{
    RobotWorkChanged stored = MakeStored("C1", "7");
    stored.resolvedJob = StartJob{};
    CHECK_FALSE(IsUnresolvedAfter(stored, MakeShown("C1", "8")));
}

TEST_CASE("WorkRecord: a robot that gets no work is checked when it shows its progress token, or may get work again")
{
    WorkRecord record;
    record.Restore(MakeStored("C1", "7"));
    CHECK_FALSE(record.TryCheckEvidence(MakeFaulty("C9"), true));
    CHECK_FALSE(record.IsUnresolved());
    SECTION("it shows the stored token")
    {
        CHECK(record.TryCheckEvidence(MakeFaulty("C9", "7"), true));
        CHECK_FALSE(record.IsUnresolved());
    }
    SECTION("it shows another one")
    {
        CHECK(record.TryCheckEvidence(MakeShown("C1", "8"), true));
        CHECK(record.IsUnresolved());
    }
    SECTION("it shows none any more: only its command counts")
    {
        CHECK(record.TryCheckEvidence(MakeShown("C9"), true));
        CHECK(record.IsUnresolved());
    }
    SECTION("its plan has ended")
    {
        CHECK_FALSE(record.TryCheckEvidence(MakeFaulty("C1"), false));
        CHECK_FALSE(record.TryCheckEvidence(MakeShown("C1", "8"), true));
        CHECK_FALSE(record.IsUnresolved());
    }
    CHECK_FALSE(record.TryCheckEvidence(MakeShown("C1", "9"), true));
}

TEST_CASE("WorkRecord: without a plan there is nothing to doubt, and a doubt is cleared once")
{
    WorkRecord record;
    record.Restore(MakeStored("C1"));
    CHECK_FALSE(record.TryCheckEvidence(MakeShown("C2"), false));
    CHECK_FALSE(record.IsUnresolved());
    record.MarkUnresolved();
    CHECK(record.TryResolve());
    CHECK_FALSE(record.TryResolve());
}

TEST_CASE("WorkRecord: the work is stored when it has changed, and a progress token only with a plan")
{
    WorkRecord record;
    CHECK_FALSE(record.TryBeginStore(record.Make("LR01"))); // there is no command yet
    record.AddCommand("C1");
    const RobotWorkChanged work = record.Make("LR01");
    CHECK(record.TryBeginStore(work));
    record.OnStored(work);
    CHECK_FALSE(record.TryBeginStore(work));

    RobotWorkChanged marked = work;
    marked.progressToken = "7";
    CHECK_FALSE(record.TryBeginStore(marked));
    record.BeginPlan(std::nullopt);
    CHECK(record.TryBeginStore(marked));
    CHECK_FALSE(record.TryBeginStore(marked));
    CHECK(record.Make("LR01").commandID == "C1");
}

TEST_CASE("WorkRecord: the first plan stores the command that the robot shows of others")
{
    WorkRecord record;
    record.BeginPlan("foreign");
    CHECK(record.Make("LR01").commandID == "foreign");
}
