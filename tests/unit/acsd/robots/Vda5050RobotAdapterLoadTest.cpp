#include "robots/VehicleFixture.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using Planning::EActionEffect;
using Planning::JobFinished;
using Planning::JobUnresolved;
using Planning::PortLoad;

constexpr Planning::AdapterTimerID LOAD_TIMER = 50;

JobMethods MakeMethods(const std::string& ports)
{
    JobMethods methods(
        LoadPositions(*Core::ParseLocationRange("LR01." + ports), {{"CP02", "rear"}}),
        std::make_shared<const StationTable>());
    methods.SetMethod("CassetteLoad", {}, {"pick", 0, {}, {}, EActionEffect::Load});
    methods.SetMethod("CassetteUnload", {}, {"drop", 0, {}, {}, EActionEffect::Unload});
    methods.SetMethod("Shift", {}, {"shift", 0, {}, {}, EActionEffect::Move});
    return methods;
}

struct LoadFixture : VehicleFixture
{
    explicit LoadFixture(const std::string& ports = "CP01-02")
        : VehicleFixture(MakeMethods(ports))
    {
        state.loads.emplace();
        ComeOnline();
    }

    static VDA5050::Load MakeLoad(const std::string& position, std::optional<std::string> loadIDOrNull)
    {
        VDA5050::Load load;
        load.loadPosition = position;
        load.loadID = std::move(loadIDOrNull);
        return load;
    }

    void Show(std::vector<VDA5050::Load> loads)
    {
        state.loads = std::move(loads);
        ShowState();
    }

    /// A job whose action the vehicle reports finished.
    void Finish(const std::string& action, const std::string& from, const std::string& to)
    {
        Planning::StartJob job = MakeJob(action);
        job.from = from;
        job.to = to;
        Command(job);
        ShowOrder(TakeOrders().at(0), {});
        state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Finished, ""}};
        ShowState();
    }

    void FireLoadTimer()
    {
        adapter.OnTimer(LOAD_TIMER, clock.GetNow(), actions);
    }

    [[nodiscard]] std::optional<std::vector<PortLoad>> GetLoadsOrNull() const
    {
        return TakeEvents<Planning::StateChanged>().back().loads;
    }
};

} // namespace

TEST_CASE("6.10 The loads of the vehicle become one entry per port, in the order of the ports")
{
    LoadFixture vehicle;
    CHECK(vehicle.GetLoadsOrNull() == std::vector<PortLoad>{{"LR01.CP01", false, ""}, {"LR01.CP02", false, ""}});
    vehicle.Show({LoadFixture::MakeLoad("rear", "C7")});
    CHECK(vehicle.GetLoadsOrNull() == std::vector<PortLoad>{{"LR01.CP01", false, ""}, {"LR01.CP02", true, "C7"}});
    vehicle.Show({LoadFixture::MakeLoad("CP01", std::nullopt), LoadFixture::MakeLoad("rear", "")});
    CHECK(vehicle.GetLoadsOrNull() == std::vector<PortLoad>{{"LR01.CP01", true, ""}, {"LR01.CP02", true, ""}});
    vehicle.Show({LoadFixture::MakeLoad("CP02", "C7"), LoadFixture::MakeLoad("", "C8")});
    CHECK_FALSE(vehicle.GetLoadsOrNull().has_value()); // where they are is not known
    vehicle.state.loads.reset();
    vehicle.ShowState();
    CHECK_FALSE(vehicle.GetLoadsOrNull().has_value());
}

TEST_CASE("A load without a position is on the only port; a robot without ports has no loads")
{
    LoadFixture one("CP01");
    one.Show({LoadFixture::MakeLoad("", "C1")});
    CHECK(one.GetLoadsOrNull() == std::vector<PortLoad>{{"LR01.CP01", true, "C1"}});
    VehicleFixture none;
    none.state.loads.emplace();
    none.ComeOnline();
    CHECK_FALSE(none.TakeEvents<Planning::StateChanged>().back().loads.has_value());
}

TEST_CASE("A job is finished with its action where the loads show it, or the vehicle shows none")
{
    SECTION("the id")
    {
        LoadFixture vehicle;
        vehicle.state.loads = {LoadFixture::MakeLoad("rear", "C1")};
        vehicle.Finish("CassetteLoad", "A01.CP01", "LR01.CP02");
        CHECK(vehicle.TakeEvents<JobFinished>() == std::vector<JobFinished>{{"J"}});
    }
    SECTION("a carrier without id")
    {
        LoadFixture vehicle;
        vehicle.state.loads = {LoadFixture::MakeLoad("rear", "")};
        vehicle.Finish("CassetteLoad", "A01.CP01", "LR01.CP02");
        CHECK(vehicle.TakeEvents<JobFinished>().size() == 1);
    }
    SECTION("empty after an unload")
    {
        LoadFixture vehicle;
        vehicle.state.loads = {LoadFixture::MakeLoad("CP01", "C9")};
        vehicle.Finish("CassetteUnload", "LR01.CP02", "A01.CP01");
        CHECK(vehicle.TakeEvents<JobFinished>().size() == 1);
    }
    SECTION("no loads at all")
    {
        LoadFixture vehicle;
        vehicle.state.loads.reset();
        vehicle.Finish("CassetteLoad", "A01.CP01", "LR01.CP02");
        CHECK(vehicle.TakeEvents<JobFinished>().size() == 1);
    }
}

TEST_CASE("A job whose loads disagree with its finished action is finished as soon as they agree")
{
    LoadFixture vehicle;
    vehicle.actions.clear();
    vehicle.Finish("CassetteLoad", "A01.CP01", "LR01.CP02");
    CHECK(vehicle.TakeEvents<JobFinished>().empty());
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().empty());
    CHECK(
        std::ranges::count(
            vehicle.actions,
            Planning::AdapterAction(Planning::StartAdapterTimer{LOAD_TIMER, std::chrono::seconds(10)}))
        == 1);
    vehicle.Show({LoadFixture::MakeLoad("CP01", "C1")});
    CHECK(vehicle.TakeEvents<JobFinished>().empty());
    vehicle.Show({LoadFixture::MakeLoad("rear", "C1")});
    CHECK(vehicle.TakeEvents<JobFinished>() == std::vector<JobFinished>{{"J"}});
    CHECK(std::ranges::count(vehicle.actions, Planning::AdapterAction(Planning::CancelAdapterTimer{LOAD_TIMER})) == 1);
    vehicle.FireLoadTimer(); // too late
    vehicle.Show({});
    CHECK(vehicle.TakeEvents<JobFinished>().size() == 1);
    CHECK(vehicle.TakeEvents<JobUnresolved>().empty());
}

TEST_CASE("A job whose loads disagree is not judged while the vehicle is disconnected")
{
    LoadFixture vehicle;
    vehicle.Finish("CassetteLoad", "A01.CP01", "LR01.CP02");
    vehicle.adapter.OnLinkDown(vehicle.clock.GetNow(), vehicle.actions);
    vehicle.actions.clear();
    vehicle.FireLoadTimer();
    CHECK(vehicle.TakeEvents<JobUnresolved>().empty());
    CHECK(
        std::ranges::count(
            vehicle.actions,
            Planning::AdapterAction(Planning::StartAdapterTimer{LOAD_TIMER, std::chrono::seconds(10)}))
        == 1);
    vehicle.state.loads = {LoadFixture::MakeLoad("rear", "C1")};
    vehicle.ComeOnline();
    CHECK(vehicle.TakeEvents<JobFinished>() == std::vector<JobFinished>{{"J"}});
}

TEST_CASE("A job whose loads keep disagreeing is unresolved, with port, expected and reported load")
{
    const auto find = [](const std::string& action,
                         const std::string& from,
                         const std::string& to,
                         const std::vector<VDA5050::Load>& loads) {
        LoadFixture vehicle;
        vehicle.state.loads = loads;
        vehicle.Finish(action, from, to);
        CHECK(vehicle.TakeEvents<JobFinished>().empty());
        vehicle.FireLoadTimer();
        vehicle.FireLoadTimer();
        const auto uncertain = vehicle.TakeEvents<JobUnresolved>();
        REQUIRE(uncertain.size() == 1);
        CHECK(uncertain[0].jobID == "J");
        vehicle.Show({LoadFixture::MakeLoad("rear", "C1")});
        CHECK(vehicle.TakeEvents<JobFinished>().empty()); // an operator decides
        const std::string begin = "the vehicle reports the action finished, but its loads disagree: ";
        REQUIRE(uncertain[0].reason.starts_with(begin));
        return uncertain[0].reason.substr(begin.size());
    };
    CHECK(find("CassetteLoad", "A01.CP01", "LR01.CP02", {}) == "LR01.CP02: expected C1, the vehicle shows no carrier");
    CHECK(
        find("CassetteLoad", "A01.CP01", "LR01.CP02", {LoadFixture::MakeLoad("rear", "C2")})
        == "LR01.CP02: expected C1, the vehicle shows C2");
    CHECK(
        find("CassetteUnload", "LR01.CP02", "A01.CP01", {LoadFixture::MakeLoad("rear", "")})
        == "LR01.CP02: expected no carrier, the vehicle shows a carrier without id");
    CHECK(
        find(
            "Shift",
            "LR01.CP01",
            "LR01.CP02",
            {LoadFixture::MakeLoad("CP01", "C1"), LoadFixture::MakeLoad("rear", "C1")})
        == "LR01.CP01: expected no carrier, the vehicle shows C1");
}

TEST_CASE("A vehicle that stops reporting loads does not confirm a job that they contradicted")
{
    LoadFixture vehicle;
    vehicle.Finish("CassetteLoad", "A01.CP01", "LR01.CP02");
    vehicle.state.loads.reset();
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<JobFinished>().empty());
    vehicle.FireLoadTimer();
    const auto uncertain = vehicle.TakeEvents<JobUnresolved>();
    REQUIRE(uncertain.size() == 1);
    CHECK(uncertain[0].reason.ends_with("it no longer reports any"));
}

TEST_CASE("After a restart a finished action is held against the loads too")
{
    LoadFixture vehicle;
    vehicle.state.orderID = "U1";
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Finished, ""}};
    Planning::StartJob job = MakeJob("CassetteLoad");
    job.to = "LR01.CP02";
    vehicle.ShowState();
    vehicle.Command(Planning::RecoverJob{job, {}});
    CHECK(vehicle.TakeEvents<JobFinished>().empty());
    vehicle.Show({LoadFixture::MakeLoad("rear", "C1")});
    CHECK(vehicle.TakeEvents<JobFinished>() == std::vector<JobFinished>{{"J"}});
}

TEST_CASE("A job that was interrupted is judged by the loads when the vehicle is in automatic mode again")
{
    LoadFixture vehicle;
    Planning::StartJob job = MakeJob("Shift");
    job.from = "LR01.CP01";
    job.to = "LR01.CP02";
    vehicle.Show({LoadFixture::MakeLoad("CP01", "C1")});
    vehicle.Command(job);
    vehicle.ShowOrder(vehicle.TakeOrders().at(0), {});
    vehicle.state.actionStates = {{"U1", "shift", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ShowState();
    vehicle.state.operatingMode = VDA5050::EOperatingMode::Manual;
    vehicle.state.actionStates = {{"U1", "shift", "", VDA5050::EActionStatus::Failed, "the mode changed"}};
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().empty());
    vehicle.state.operatingMode = VDA5050::EOperatingMode::Automatic;
    SECTION("nothing was moved")
    {
        vehicle.ShowState();
        CHECK(vehicle.TakeEvents<Planning::JobInterrupted>().empty()); // the loads may follow later
        vehicle.FireLoadTimer();
        CHECK(
            vehicle.TakeEvents<Planning::JobInterrupted>()
            == std::vector<Planning::JobInterrupted>{{"J", "the mode changed"}});
        CHECK(vehicle.TakeEvents<JobFinished>().empty());
    }
    SECTION("the operator has completed it")
    {
        vehicle.Show({LoadFixture::MakeLoad("rear", "C1")});
        CHECK(vehicle.TakeEvents<JobFinished>().size() == 1);
        CHECK(vehicle.TakeEvents<Planning::JobInterrupted>().empty());
    }
    SECTION("its loads follow later")
    {
        vehicle.ShowState();
        vehicle.Show({LoadFixture::MakeLoad("rear", "C1")});
        CHECK(vehicle.TakeEvents<JobFinished>().size() == 1);
        vehicle.FireLoadTimer();
    }
    SECTION("it is switched to manual mode again before its loads have had their time")
    {
        vehicle.ShowState();
        vehicle.state.operatingMode = VDA5050::EOperatingMode::Manual;
        vehicle.ShowState();
        vehicle.FireLoadTimer();
        CHECK(vehicle.TakeEvents<Planning::JobInterrupted>().empty());
        vehicle.state.operatingMode = VDA5050::EOperatingMode::Automatic;
        vehicle.ShowState();
        vehicle.FireLoadTimer();
        CHECK(vehicle.TakeEvents<Planning::JobInterrupted>().size() == 1);
    }
    SECTION("the loads prove neither")
    {
        vehicle.Show({});
        vehicle.FireLoadTimer();
        const auto unresolved = vehicle.TakeEvents<JobUnresolved>();
        REQUIRE(unresolved.size() == 1);
        CHECK(unresolved[0].reason == "the mode changed; the loads of the vehicle do not show whether it was done");
    }
    SECTION("it is cancelled meanwhile")
    {
        vehicle.Command(Planning::CancelJob{"J"});
        CHECK(vehicle.TakeEvents<Planning::JobFailed>().size() == 1);
        vehicle.ShowState();
        CHECK(vehicle.TakeEvents<Planning::JobInterrupted>().empty());
    }
    vehicle.ShowState();
    CHECK(
        vehicle.TakeEvents<Planning::JobInterrupted>().size() + vehicle.TakeEvents<JobFinished>().size()
            + vehicle.TakeEvents<JobUnresolved>().size() + vehicle.TakeEvents<Planning::JobFailed>().size()
        == 1);
}

TEST_CASE("An interrupted move between a station and the robot is judged by the port of the robot alone")
{
    LoadFixture vehicle;
    Planning::StartJob job = MakeJob("Shift");
    job.from = "A01.CP01";
    job.to = "LR01.CP01";
    vehicle.Show({});
    vehicle.Command(job);
    vehicle.ShowOrder(vehicle.TakeOrders().at(0), {});
    vehicle.state.operatingMode = VDA5050::EOperatingMode::Manual;
    vehicle.state.actionStates = {{"U1", "shift", "", VDA5050::EActionStatus::Failed, "the mode changed"}};
    vehicle.ShowState();
    vehicle.state.operatingMode = VDA5050::EOperatingMode::Automatic;
    SECTION("the operator has completed it")
    {
        vehicle.Show({LoadFixture::MakeLoad("CP01", "C1")});
        CHECK(vehicle.TakeEvents<JobFinished>().size() == 1);
    }
    SECTION("nothing was moved")
    {
        vehicle.ShowState();
        vehicle.FireLoadTimer();
        CHECK(vehicle.TakeEvents<Planning::JobInterrupted>().size() == 1);
    }
    CHECK(vehicle.TakeEvents<JobUnresolved>().empty());
}

TEST_CASE("A job whose order the vehicle lost is judged by the loads; without loads an operator resolves it")
{
    LoadFixture vehicle;
    const bool bShowsLoads = GENERATE(true, false);
    if (!bShowsLoads)
    {
        vehicle.state.loads.reset();
    }
    Planning::StartJob job = MakeJob("CassetteLoad");
    job.from = "A01.CP01";
    job.to = "LR01.CP02";
    vehicle.Command(job);
    vehicle.ShowOrder(vehicle.TakeOrders().at(0), {});
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ShowState();
    vehicle.state.orderID.clear(); // it was restarted
    vehicle.state.actionStates.clear();
    vehicle.ShowState();
    vehicle.FireLoadTimer();
    CHECK(vehicle.TakeEvents<Planning::JobInterrupted>().size() == (bShowsLoads ? 1U : 0U));
    const auto unresolved = vehicle.TakeEvents<JobUnresolved>();
    REQUIRE(unresolved.size() == (bShowsLoads ? 0U : 1U));
    CHECK((bShowsLoads || unresolved[0].reason.ends_with("; the vehicle reports no loads")));
}

TEST_CASE("A job whose order ends without the end of its action is judged by the loads")
{
    LoadFixture vehicle;
    Planning::StartJob job = MakeJob("CassetteLoad");
    job.from = "A01.CP01";
    job.to = "LR01.CP02";
    vehicle.Command(job);
    vehicle.ShowOrder(vehicle.TakeOrders().at(0), {});
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ShowState();
    vehicle.state.actionStates.clear();
    vehicle.ShowState();
    vehicle.FireLoadTimer();
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().empty());
    const auto interrupted = vehicle.TakeEvents<Planning::JobInterrupted>();
    REQUIRE(interrupted.size() == 1);
    CHECK(interrupted[0].reason == "the order ended without an end of its action");
}

} // namespace ACS::Acsd::Test
