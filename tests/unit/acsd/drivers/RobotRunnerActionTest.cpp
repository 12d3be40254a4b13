#include "Catch.hpp"
#include "common/http/MetricsEndpoint.hpp"
#include "drivers/RobotRunner.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include <acs/acsd/IRobotSetup.hpp>

#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A robot with instant actions of its own, and its adapter.
class ActingRobot final : public IRobot, public Planning::IRobotAdapter, public IRobotActions
{
    RobotServices _services;
    std::size_t _count = 0;

public:
    std::vector<RobotActionChange> changes;
    std::size_t calls = 0; ///< Of OnAdapterCalled.

    explicit ActingRobot(RobotServices services)
        : _services(std::move(services))
    {
    }

    [[nodiscard]] Planning::IRobotAdapter& GetAdapter() noexcept override
    {
        return *this;
    }

    void Start() override
    {
    }

    void Stop() override
    {
    }

    void OnAdapterCalled() override
    {
        ++calls;
    }

    void UpdateMetrics() override
    {
    }

    [[nodiscard]] IRobotActions* GetActionsOrNull() noexcept override
    {
        return this;
    }

    void Handle(const Planning::RobotCommand& /*command*/, Core::Now /*now*/, Planning::AdapterActions& /*out*/)
        override
    {
    }

    void OnTimer(Planning::AdapterTimerID /*timer*/, Core::Now /*now*/, Planning::AdapterActions& /*out*/) override
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return std::nullopt;
    }

    [[nodiscard]] std::vector<RobotActionOffer> ListOffers() const override
    {
        return {{"beep", {}, {}}};
    }

    [[nodiscard]] tl::expected<std::string, RobotActionRefusal> Request(
        const RobotActionRequest& request,
        Core::Now /*now*/,
        Planning::AdapterActions& /*out*/) override
    {
        if (request.actionType != "beep")
        {
            return tl::make_unexpected(RobotActionRefusal{true, "It can only beep."});
        }
        return "beep-" + std::to_string(++_count);
    }

    [[nodiscard]] std::vector<RobotActionChange> TakeChanges() override
    {
        return std::exchange(changes, {});
    }

    /// As by a message of the robot.
    void End(const std::string& actionID, ERobotActionStatus status)
    {
        _services.call([&](Core::Now, Planning::AdapterActions&) { changes.push_back({actionID, status, "done"}); });
    }
};

class ActingSetup final : public IRobotSetup
{
    ActingRobot** _made;

public:
    explicit ActingSetup(ActingRobot*& made)
        : _made(&made)
    {
    }

    [[nodiscard]] RobotCapabilities GetCapabilities() const override
    {
        return {};
    }

    [[nodiscard]] std::unique_ptr<IRobot> MakeRobot(RobotServices services) const override
    {
        auto robot = std::make_unique<ActingRobot>(std::move(services));
        *_made = robot.get();
        return robot;
    }
};

/// A runner with such a robot, and the entries of the event feed.
struct ActingFixture
{
    boost::asio::io_context context;
    Testing::ManualClock clock;
    Testing::SeededRandom random{1};
    Testing::RecordingLogSink log;
    Apps::MetricsEndpoint metrics;
    std::vector<std::string> entries;
    ActingRobot* made = nullptr;
    RobotRunner robot{
        {context.get_executor(),
         clock,
         random,
         Core::Logger(log, "acsd"),
         metrics,
         nullptr,
         nullptr,
         [this](const std::string& robotID, const RobotActionRecord& record) {
             entries.push_back(DescribeAction(robotID, record));
         }},
        MakeLink(),
        {}};

    RobotLinkConfig MakeLink()
    {
        RobotLinkConfig link;
        link.robotID = "LR01";
        link.driver = "acting";
        link.setupOrNull = std::make_shared<ActingSetup>(made);
        return link;
    }
};

} // namespace

TEST_CASE_METHOD(
    ActingFixture,
    "A robot of any driver may offer instant actions; their course is recorded and published")
{
    CHECK(robot.ListActionOffers().size() == 1);
    const auto refused = robot.RequestAction({"sing", {}}, {});
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error() == RobotActionRefusal{true, "It can only beep."});
    CHECK(robot.GetActions().empty());
    const auto sent = robot.RequestAction({"beep", {}}, "where is it");
    REQUIRE(sent.has_value());
    CHECK(made->calls == 2);
    REQUIRE(robot.GetActions().size() == 1);
    CHECK(robot.GetActions()[0].requestedAt == clock.GetNow().wall);
    made->End(*sent, ERobotActionStatus::Running);
    CHECK(robot.GetActions()[0].status == ERobotActionStatus::Running);
    made->End(*sent, ERobotActionStatus::Finished);
    made->End(*sent, ERobotActionStatus::Finished);
    CHECK(robot.GetActions()[0].endedAt.has_value());
    CHECK(
        entries
        == std::vector<std::string>{
            "action beep of LR01: requested: where is it",
            "action beep of LR01: Finished: done"});
}

TEST_CASE_METHOD(ActingFixture, "A robot with too many instant actions that have not ended gets no more of them")
{
    for (std::size_t i = 0; i < ActionHistory::MOST_RECORDS; ++i)
    {
        REQUIRE(robot.RequestAction({"beep", {}}, {}).has_value());
    }
    CHECK(
        robot.RequestAction({"beep", {}}, {}).error()
        == RobotActionRefusal{false, "32 instant actions of the robot have not ended."});
    made->End("beep-5", ERobotActionStatus::Failed);
    CHECK(robot.RequestAction({"beep", {}}, {}).has_value());
    CHECK(robot.GetActions().size() == ActionHistory::MOST_RECORDS);
    robot.Stop();
    CHECK_FALSE(robot.RequestAction({"beep", {}}, {}).has_value());
    CHECK(robot.ListActionOffers().empty());
}

} // namespace ACS::Acsd::Test
