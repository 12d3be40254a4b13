#include "Catch.hpp"
#include "SeededRandom.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/MasterSession.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace ACS::VDA5050::Test
{

namespace
{

/// A master and a vehicle with a broker between them that loses messages; time moves by steps.
class Line
{
    Testing::ManualClock _clock;
    Testing::SeededRandom _random;
    std::uint32_t _lossPercent = 0;
    MasterSession _master;
    VehicleSession _vehicle;
    MasterActions _events;
    std::optional<std::uint32_t> _goal;
    std::vector<std::string> _running;

public:
    Line(std::uint64_t seed, std::uint32_t lossPercent)
        : _random(seed),
          _master(MakeMasterOptions()),
          _vehicle(VehicleSessionFixture::MakeOptions())
    {
        AgvPosition position;
        position.bPositionInitialized = true;
        position.mapID = "floor";
        _vehicle.OnPosition(position, Velocity{});
        MasterActions out;
        _master.OnLinkUp(_clock.GetNow(), out);
        VehicleActions up;
        _vehicle.OnLinkUp(_clock.GetNow(), up);
        ToMaster(up);
        SetLoss(lossPercent); // the connect itself loses nothing
    }

    void SetLoss(std::uint32_t percent)
    {
        _lossPercent = percent;
    }

    [[nodiscard]] MasterSession& GetMaster()
    {
        return _master;
    }

    [[nodiscard]] const MasterActions& GetEvents() const
    {
        return _events;
    }

    [[nodiscard]] Core::Now GetNow() const
    {
        return _clock.GetNow();
    }

    void Execute(const MasterActions& actions)
    {
        ToVehicle(actions);
    }

    /// Three seconds: the vehicle reaches its goal, ends its actions, and every timer of both is due.
    void Step()
    {
        _clock.Advance(std::chrono::seconds(3));
        VehicleActions out;
        for (const std::string& actionID : std::exchange(_running, {}))
        {
            CHECK(_vehicle.TrySetActionStatus(actionID, EActionStatus::Running, {}, _clock.GetNow(), out));
            CHECK(_vehicle.TrySetActionStatus(actionID, EActionStatus::Finished, "ok", _clock.GetNow(), out));
        }
        if (_goal.has_value())
        {
            CHECK(_vehicle.TryReachNode({*std::exchange(_goal, std::nullopt)}, _clock.GetNow(), out));
        }
        _vehicle.OnTimer(EVehicleTimer::MaximumStateInterval, _clock.GetNow(), out);
        ToMaster(out);
        MasterActions actions;
        _master.OnTimer(EMasterTimer::ResendOrder, _clock.GetNow(), actions);
        _master.OnTimer(EMasterTimer::ResendInstantActions, _clock.GetNow(), actions);
        ToVehicle(actions);
    }

private:
    [[nodiscard]] static MasterOptions MakeMasterOptions()
    {
        MasterOptions options;
        options.address = MakeAddress();
        return options;
    }

    [[nodiscard]] bool IsLost()
    {
        return _random.GetNext() % 100 < _lossPercent;
    }

    void ToVehicle(const MasterActions& actions)
    {
        CheckPublished(actions);
        for (const PublishMessage& publish : Pick<PublishMessage>(actions))
        {
            if (!IsLost())
            {
                VehicleActions out;
                _vehicle.OnMessage(publish.message.topic, publish.message.payload, false, _clock.GetNow(), out);
                ToMaster(out);
            }
        }
        std::copy(actions.begin(), actions.end(), std::back_inserter(_events));
    }

    void ToMaster(const VehicleActions& actions)
    {
        CheckPublished(actions);
        for (const DriveTo& drive : Pick<DriveTo>(actions))
        {
            _goal = drive.node.sequenceID;
        }
        for (const StartAction& start : Pick<StartAction>(actions))
        {
            _running.push_back(start.action.actionID);
        }
        for (const PublishMessage& publish : Pick<PublishMessage>(actions))
        {
            if (!IsLost())
            {
                MasterActions out;
                _master.OnMessage(publish.message.topic, publish.message.payload, _clock.GetNow(), out);
                ToVehicle(out);
            }
        }
    }
};

} // namespace

TEST_CASE("13 With a third of the messages lost each order and action is executed once and every node reported")
{
    const auto seed = static_cast<std::uint64_t>(GENERATE(range(1, 21)));
    CAPTURE(seed);
    Line line(seed, 33);
    REQUIRE(line.GetMaster().CanTakeOrder());
    std::vector<OrderNode> nodes = MakeNodes(5);
    nodes[2].actions.push_back(MakeAction("a1", EBlockingType::Hard));
    nodes[4].actions.push_back(MakeAction("a2", EBlockingType::Soft));
    OrderBuilder builder = *OrderBuilder::Create("order-1", nodes, MakeEdges(4));
    MasterActions out;
    REQUIRE(line.GetMaster().SendOrder(*builder.MakeOrder(2), line.GetNow(), out).has_value());
    line.Execute(out);
    out.clear();
    REQUIRE(line.GetMaster().SendOrderUpdate(*builder.MakeUpdate(5), line.GetNow(), out).has_value());
    line.Execute(out);
    for (int i = 0; i < 100 && line.GetMaster().GetOrderPhase() != EOrderPhase::None; ++i)
    {
        line.Step();
    }
    CHECK(Pick<OrderFinished>(line.GetEvents()).size() == 1);
    CHECK(Pick<OrderRejected>(line.GetEvents()).empty());
    CHECK(Pick<OrderAccepted>(line.GetEvents()).size() == 2);
    const std::vector<NodeReached> reached = Pick<NodeReached>(line.GetEvents());
    REQUIRE(reached.size() == 5);
    for (std::size_t index = 0; index < reached.size(); ++index)
    {
        CHECK(reached[index].sequenceID == 2 * index);
    }
}

} // namespace ACS::VDA5050::Test
