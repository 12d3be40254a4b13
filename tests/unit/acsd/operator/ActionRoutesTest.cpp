#include "operator/ActionRoutes.hpp"

#include "Catch.hpp"
#include "operator/CommandBodies.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd::Test
{

namespace
{

/// An operator who calls the routes directly, of acsd with the robot LR01.
class Requester
{
    Apps::HttpRoutes _routes;

public:
    bool bStopping = false;
    RobotActionsView view;
    ActionAccess::Requested answer = "acs-7";
    std::optional<RobotActionRequest> request; ///< As the robot has it.
    std::string reason;

    Requester()
    {
        AddActionRoutes(
            _routes,
            {[this] { return bStopping; },
             [this](const std::string& robotID) { return robotID == "LR01" ? std::optional(view) : std::nullopt; },
             [this](const std::string& robotID, const RobotActionRequest& sent, const std::string& why)
                 -> std::optional<ActionAccess::Requested> {
                 if (robotID != "LR01")
                 {
                     return std::nullopt;
                 }
                 request = sent;
                 reason = why;
                 return answer;
             }});
    }

    Requester(const Requester&) = delete;
    Requester& operator=(const Requester&) = delete;
    ~Requester() = default;

    [[nodiscard]] std::string Send(std::string_view method, std::string_view target, const std::string& body = {}) const
    {
        Apps::HttpRequest sent = *Apps::ParseHttpTarget(target);
        sent.method = method;
        sent.body = body;
        const Apps::HttpResponse response = _routes.Respond(sent);
        return std::to_string(response.status) + " " + response.body;
    }

    [[nodiscard]] std::string Post(const std::string& body) const
    {
        return Send("POST", "/v1/robots/LR01/actions", body);
    }
};

constexpr const char* STATE_REQUEST = R"({"actionType":"stateRequest"})";

} // namespace

TEST_CASE("POST /v1/robots/ID/actions passes the parameters to the robot as they are, and answers with the id")
{
    Requester user;
    CHECK(
        user.Post(
            R"({"actionType":"initPosition","parameters":{"x":1.50,"mapId":"f","on":true,"o":{"a":[1]}},"reason":"moved"})")
        == "202 {\"message\":\"initPosition is sent to LR01; /v1/robots/LR01/actions shows its outcome.\","
           "\"actionId\":\"acs-7\"}\n");
    REQUIRE(user.request.has_value());
    CHECK(user.reason == "moved");
    CHECK(user.request->actionType == "initPosition");
    REQUIRE(user.request->parameters.size() == 4);
    CHECK(user.request->parameters[0].value.GetNumberOrNull() == 1.5);
    CHECK(user.request->parameters[1] == RobotActionParameter{"mapId", Core::JsonText::FromString("f")});
    CHECK(user.request->parameters[2].value.GetText() == "true");
    CHECK(user.request->parameters[3].value.GetText() == R"({"a":[1]})");
    CHECK(user.Post(STATE_REQUEST).starts_with("202 "));
    CHECK(user.request->parameters.empty());
}

TEST_CASE("POST /v1/robots/ID/actions refuses an invalid body before the robot has it")
{
    Requester user;
    for (const std::string body :
         {R"({})",
          R"({"actionType":""})",
          R"({"actionType":7})",
          R"({"actionType":"beep","ghost":1})",
          R"({"actionType":"beep","parameters":[]})",
          R"({"actionType":"beep","parameters":{"x":1,"x":2}})",
          R"({"actionType":"beep","parameters":{"x":{"y":1,"y":2}}})",
          R"({"actionType":"beep","parameters":{"x":null}})",
          R"({"actionType":"beep","parameters":{"":1}})",
          R"({"actionType":"be\u0007ep"})"})
    {
        INFO(body);
        CHECK(user.Post(body).starts_with(R"(400 {"error":"Invalid body: )"));
    }
    const std::string most(MOST_PARAMETER_BYTES, 'x');
    CHECK(user.Post(R"({"actionType":"beep","parameters":{"x":")" + most + "\"}}").starts_with("400 "));
    CHECK(user.Send("POST", "/v1/robots/LR01/actions?force=1", STATE_REQUEST).starts_with("400 "));
    CHECK_FALSE(user.request.has_value());
}

TEST_CASE("POST /v1/robots/ID/actions answers with the robot's refusal, or the reason why there is none")
{
    Requester user;
    user.answer = tl::make_unexpected(RobotActionRefusal{true, "The robot has no instant action 'beep'."});
    CHECK(user.Post(STATE_REQUEST) == "400 {\"error\":\"The robot has no instant action 'beep'.\"}\n");
    user.answer = tl::make_unexpected(RobotActionRefusal{false, "The robot is not connected."});
    CHECK(user.Post(STATE_REQUEST) == "409 {\"error\":\"The robot is not connected.\"}\n");
    CHECK(
        user.Send("POST", "/v1/robots/LR09/actions", STATE_REQUEST)
        == R"(404 {"error":"There is no robot \"LR09\"; /v1/robots and acsctl robots list them."})"
           "\n");
    CHECK(user.Send("GET", "/v1/robots/LR09/actions").starts_with("404 "));
    user.request.reset();
    user.bStopping = true;
    CHECK(user.Post(STATE_REQUEST) == "503 {\"error\":\"acsd is stopping and accepts no requests.\"}\n");
    CHECK_FALSE(user.request.has_value());
}

TEST_CASE("GET /v1/robots/ID/actions shows the last actions with their outcome, and what the robot offers")
{
    Requester user;
    CHECK(user.Send("GET", "/v1/robots/LR01/actions") == "200 {\"actions\":[],\"offered\":[]}\n");
    const Core::WallTime begin{std::chrono::hours(1)};
    user.view.actions.push_back(
        {"a1",
         "logReport",
         {{"reason", Core::JsonText::FromString("test")}},
         "a fault",
         begin,
         ERobotActionStatus::Running,
         {},
         std::nullopt});
    user.view.actions.push_back(
        {"a2", "stateRequest", {}, {}, begin, ERobotActionStatus::Failed, "busy", begin + std::chrono::seconds(1)});
    user.view.offered.push_back({"logReport", "writes a log", {{"reason", "STRING", true}}});
    CHECK(
        user.Send("GET", "/v1/robots/LR01/actions")
        == R"(200 {"actions":[{"actionId":"a1","actionType":"logReport","parameters":{"reason":"test"},"reason":"a fault",)"
           R"("requestedAt":"1970-01-01T01:00:00.000Z","status":"Running","resultDescription":"","endedAt":null},)"
           R"({"actionId":"a2","actionType":"stateRequest","parameters":{},"reason":"",)"
           R"("requestedAt":"1970-01-01T01:00:00.000Z","status":"Failed","resultDescription":"busy",)"
           R"("endedAt":"1970-01-01T01:00:01.000Z"}],"offered":[{"actionType":"logReport","description":"writes a log",)"
           R"("parameters":[{"key":"reason","valueType":"STRING","required":true}]}]})"
           "\n");
    CHECK(user.Send("GET", "/v1/robots/LR01/actions?limit=1").starts_with("400 "));
}

} // namespace ACS::Acsd::Test
