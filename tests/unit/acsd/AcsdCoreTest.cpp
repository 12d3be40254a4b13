#include "AcsdCoreFixture.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

using namespace std::chrono_literals;

TEST_CASE_METHOD(
    AcsdCoreFixture,
    "The inability to accept work is reported after the grace time, and ends with broker and robot")
{
    Begin();
    Advance(_config.operations.workGrace - 1ms);
    CHECK(_working.empty());
    Advance(1ms);
    CHECK(_working == std::vector{false});

    _core->OnMqttUp();
    CHECK(_core->IsMqttUp());
    CHECK(_working == std::vector{false});
    BringRobotUp();
    CHECK(_working == std::vector{false, true});

    _core->OnMqttDown();
    Advance(_config.operations.workGrace - 1ms);
    _core->OnMqttUp();
    Advance(_config.operations.workGrace);
    CHECK(_working == std::vector{false, true, true});
    _core->OnMqttDown();
    Advance(_config.operations.workGrace);
    CHECK(_working.back() == false);
}

TEST_CASE_METHOD(AcsdCoreFixture, "The states of the robots are repeated at the interval of the configuration")
{
    Begin();
    _statuses.clear();
    Advance(1h);
    CHECK(_statuses.empty());

    _config.operations.statusInterval = 5s;
    _core->Reload(_config);
    Advance(10s);
    CHECK(_statuses == std::vector<std::string>{"LR01", "CR01", "LR01", "CR01"});
    _config.operations.statusInterval = 0s;
    _core->Reload(_config);
    Advance(10s);
    CHECK(_statuses.size() == 4);
}

TEST_CASE_METHOD(AcsdCoreFixture, "A plan is acknowledged after it was stored; the commit is measured")
{
    Begin();
    Register();
    const std::size_t before = _commits;
    _bDiskHangs = true;
    Submit("P1");
    CHECK(_answers.empty());
    Advance(1s);
    _bDiskHangs = false;
    ServeDisk();
    REQUIRE(_answers.size() == 1);
    CHECK(_answers.front().result == Protocol::EAckResult::Success);
    CHECK(_commits > before);
    CHECK(_core->GetEngine().GetActivePlans().size() == 1);
}

TEST_CASE_METHOD(
    AcsdCoreFixture,
    "4.1 While the disk hangs, plans beyond queue.max_plans are answered with Fail at once")
{
    _config.engine.maximumPlans = 3;
    Begin();
    Register();
    _bDiskHangs = true;
    for (const char* planID : {"P1", "P2", "P3", "P4", "P5", "P6"})
    {
        Submit(planID); // P1 is being stored, three wait
    }
    REQUIRE(_answers.size() == 2);
    CHECK(_answers[0].transactionID == "T-P5");
    CHECK(_answers[0].result == Protocol::EAckResult::Fail);
    CHECK(
        _answers[0].message
        == "The ACS has not stored earlier requests yet. Send the request again later, with a new transactionId.");
    CHECK(_answers[1].transactionID == "T-P6");
    _bDiskHangs = false;
    ServeDisk();
    CHECK(_answers.size() == 6);
}

TEST_CASE_METHOD(AcsdCoreFixture, "A store that hangs or fails is a not-ready reason; an idle store is checked")
{
    Begin();
    Advance(10s);
    CHECK(_checks == 6);

    _core->OnStoreLost({Core::ECoreError::OutOfRange, "acsd.db", "the file", "nothing"});
    CHECK(_core->GetNotReadyReasons().size() == 1);
    CHECK(_core->GetStoreFaultOrNull() == _core->GetNotReadyReasons().front());
    Advance(500ms);
    CHECK(_checks == 6);
    Advance(10s); // the engine has tried to write meanwhile
    CHECK_FALSE(_core->GetStoreFaultOrNull().has_value());
    CHECK(_checks > 6);

    _bDiskHangs = true;
    Register();
    Submit("P1");
    Advance(StoreWatch::LIMIT - 1ms);
    CHECK_FALSE(_core->GetStoreFaultOrNull().has_value());
    const std::size_t checks = _checks;
    Advance(10s);
    CHECK(_core->GetStoreFaultOrNull() == "the store does not answer");
    CHECK(_checks == checks);
    _bDiskHangs = false;
    ServeDisk();
    CHECK(_core->GetNotReadyReasons().empty());
}

TEST_CASE_METHOD(
    AcsdCoreFixture,
    "A log of the store that cannot be merged is an alarm, also while a transaction is under way")
{
    Begin();
    Register();
    _bDiskHangs = true;
    Submit("P1");
    const std::size_t checks = _checks;
    Advance(2s);
    CHECK(_checks > checks); // a store that is always written is checked too
    _core->OnStoreLog({"acsd.db", std::uint64_t{1} << 30U, 0, "another program reads the database"});
    CHECK(_core->GetEngine().GetActiveAlarms().empty());
    _bDiskHangs = false;
    ServeDisk();
    REQUIRE(_core->GetEngine().GetActiveAlarms().size() == 1);
    CHECK(_core->GetEngine().GetActiveAlarms().front().errorCode == "ACS-1021");
    CHECK(_core->GetNotReadyReasons().empty());
}

TEST_CASE_METHOD(AcsdCoreFixture, "acsd ends at once, without further actions, if another program has taken its store")
{
    const Core::Error taken{Planning::EPlanningError::StoreTaken, "store", "a store of this program", "a lock"};
    Begin();
    Register();
    SECTION("A check reports it")
    {
        _core->OnStoreLost(taken);
    }
    SECTION("A transaction reports it")
    {
        _bDiskHangs = true;
        Submit("P1");
        _core->OnStored(tl::unexpected(taken));
    }
    CHECK(_takenStores == 1);
    _core->OnStoreLost(taken);
    Advance(1h);
    CHECK(_takenStores == 1);
    CHECK(_stops == 0);
    CHECK(_answers.empty());
    CHECK(_core->IsClosed());
}

TEST_CASE_METHOD(
    AcsdCoreFixture,
    "5.8 An alarm is cleared with the code that it was set with, whatever errors.map was at the restart between")
{
    const auto getErrors = [this] {
        std::vector<std::pair<std::string, bool>> errors;
        for (const Protocol::AcsRequest& request : _reports)
        {
            const auto& report = std::get<Protocol::ErrorReport>(request.payload);
            errors.emplace_back(report.errorCode, report.bSet);
        }
        return errors;
    };
    const ErrorNames before = GENERATE(ErrorNames{}, ErrorNames{{"ACS-1002", {"E77", {}, {}}}});
    const ErrorNames after = GENERATE(ErrorNames{}, ErrorNames{{"ACS-1002", {"E78", {}, {}}}});
    const std::string code = before.empty() ? "ACS-1002" : "E77";
    _config.mcs.style.errors = before;
    Begin();
    Register();
    BringRobotUp();
    _core->OnRobotEvent("LR01", Planning::LinkChanged{false});
    ServeDisk();
    REQUIRE(getErrors() == std::vector<std::pair<std::string, bool>>{{code, true}});

    Planning::StoredState state;
    state.alarms = _core->GetEngine().GetActiveAlarms();
    _config.mcs.style.errors = after;
    _reports.clear();
    _core.reset();
    Begin(std::move(state));
    Register();
    _core->OnSessionEvent(Protocol::RequestReceived{{"Q", {}, Protocol::RequestAcsErrorList{}}, false});
    REQUIRE(_answers.size() == 1);
    CHECK(std::get<Protocol::ErrorListAck>(_answers.front().payload).errors.at(0).errorCode == code);
    BringRobotUp();
    CHECK(getErrors() == std::vector<std::pair<std::string, bool>>{{code, false}});
}

TEST_CASE_METHOD(AcsdCoreFixture, "A filter decides which actions of the engine are executed")
{
    std::size_t replies = 0;
    _filter = [&replies](const Planning::EngineAction& action, const AcsdCore::ActionHandler& execute) {
        if (std::holds_alternative<Planning::ReplyCommand>(action))
        {
            ++replies;
            return;
        }
        execute(action);
    };
    Begin();
    Register();
    Submit("P1");
    CHECK(replies == 1);
    CHECK(_answers.empty());
}

} // namespace ACS::Acsd::Test
