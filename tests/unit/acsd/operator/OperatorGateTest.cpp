#include "operator/OperatorGate.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "TemporaryFolder.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::AccessPolicy;
using Acsd::EOperatorRole;

namespace
{

struct GateFixture
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink log;
    Testing::TemporaryFolder folder;
    std::unique_ptr<Acsd::AuditLog> audit =
        std::move(*Acsd::AuditLog::Create(folder.GetPath() / "audit", {}, clock, Core::Logger(log, "audit")));
    Acsd::OperatorGate gate{
        clock,
        Core::Logger(log, "operator"),
        AccessPolicy(
            {{{{EOperatorRole::Viewer, "grafana", Acsd::HashToken("read")},
               {EOperatorRole::Operator, "kim", Acsd::HashToken("write")}}},
             std::nullopt}),
        *audit};
    int commands = 0;
    std::vector<Planning::CommandReceipt> receipts; ///< Of the commands with a key.

    GateFixture()
    {
        gate.GetRoutes().Add("GET", "/page/{FILE}", [](const auto&, const auto&) {
            return Apps::HttpResponse{200, "text/css"};
        });
        gate.GetRoutes().Add("POST", "/v1/tsc/pause", [this](const auto&, const auto&) {
            ++commands;
            Apps::HttpResponse answer{202, "application/json", "{\"message\":\"paused\"}\n"};
            if (std::optional<Planning::CommandReceipt> receipt = gate.MakeReceiptOrNull(answer); receipt.has_value())
            {
                receipts.push_back(std::move(*receipt));
            }
            return answer;
        });
    }

    Apps::HttpResponse PostWithKey(const std::string& token, const std::string& key)
    {
        Apps::HttpRequest request = *Apps::ParseHttpTarget("/v1/tsc/pause");
        request.method = "POST";
        request.sender = {{"10.0.0.7", 40'000}, "Bearer " + token};
        request.headers = {{"Idempotency-Key", key}};
        return gate.Respond(request);
    }

    Apps::HttpResponse Post(const std::string& token, const std::string& target = "/v1/tsc/pause")
    {
        return Ask("POST", token, target);
    }

    Apps::HttpResponse Ask(const std::string& method, const std::string& token, const std::string& target)
    {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
        request.method = method;
        request.sender = {{"10.0.0.7", 40'000}, token.empty() ? token : "Bearer " + token};
        return gate.Respond(request);
    }

    /// As the page does it.
    Apps::HttpResponse Browse(
        const std::string& method,
        const std::string& target,
        const std::string& cookie,
        const std::string& body = {})
    {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
        request.method = method;
        request.body = body;
        request.sender.peer = {"10.0.0.7", 40'000};
        request.headers = {{"Host", "acs:8081"}, {"Origin", "http://acs:8081"}, {"Cookie", cookie}};
        return gate.Respond(request);
    }

    /// The cookie of a new session.
    std::string Login(const std::string& token)
    {
        const Apps::HttpResponse response = Browse("POST", "/v1/login", "", R"({"token":")" + token + R"("})");
        REQUIRE(response.status == 204);
        const std::string header = response.headers.at(0).second;
        return header.substr(0, header.find(';'));
    }
};

} // namespace

TEST_CASE("A request without a valid token is answered with 401 and a challenge, one of a viewer with 403")
{
    GateFixture fixture;
    for (const char* token : {"", "guess"})
    {
        const Apps::HttpResponse response = fixture.Post(token, "/unknown");
        CHECK(response.status == 401);
        CHECK(response.challenge == "Bearer realm=\"acsd\"");
        CHECK(response.body.starts_with("{\"error\":\""));
    }
    const Apps::HttpResponse forbidden = fixture.Post("read");
    CHECK(forbidden.status == 403);
    CHECK(forbidden.challenge.empty());
    CHECK(forbidden.body == "{\"error\":\"grafana is a viewer and may not send commands.\"}\n");
    CHECK(fixture.commands == 0);
    CHECK(fixture.log.Contains(Core::ELogLevel::Warning, "Refused a request to the operator interface"));
    CHECK(fixture.Post("write").status == 202);
    CHECK(fixture.commands == 1);
}

TEST_CASE("A token that was withdrawn is refused from then on")
{
    GateFixture fixture;
    CHECK(fixture.Post("write").status == 202);
    fixture.gate.SetPolicy(AccessPolicy({std::vector<Acsd::OperatorToken>{}, std::nullopt}));
    CHECK(fixture.Post("write").status == 401);
}

TEST_CASE("Each command of an identified client is in the audit log with its outcome, and no other request")
{
    GateFixture fixture;
    CHECK(fixture.Post("write").status == 202);
    CHECK(fixture.Post("read").status == 403);
    CHECK(fixture.Post("write", "/unknown").status == 404);
    CHECK(fixture.Post("guess").status == 401);
    CHECK(fixture.Ask("GET", "write", "/v1/tsc/pause").status == 405);
    const Apps::HttpResponse unknown = fixture.Ask("GET", "write", "/v1/ghosts");
    CHECK(unknown.contentType == "application/json");
    CHECK(unknown.body.starts_with(R"({"error":"not found; available paths:\nGET /v1/audit\n)"));
    CHECK(fixture.Ask("GET", "write", "/v1/tsc/pause").body == "{\"error\":\"allowed methods: POST\"}\n");
    const Apps::HttpResponse audit = fixture.Ask("GET", "read", "/v1/audit");
    CHECK(audit.status == 200);
    CHECK(audit.contentType == "application/x-ndjson");
    CHECK(std::ranges::count(audit.body, '\n') == 3);
    const std::size_t first = audit.body.find(
        R"("name":"kim","role":"operator","method":"POST","request":"/v1/tsc/pause","status":202,"answer":{"message":"paused"}})");
    const std::size_t second = audit.body.find(R"("name":"grafana","role":"viewer","method":"POST",)");
    const std::size_t third = audit.body.find(R"("request":"/unknown","status":404,)");
    CHECK(first < second);
    CHECK(second < third);
    CHECK(third != std::string::npos);
}

TEST_CASE("GET /v1/audit has the number of lines that is asked for, from 1 to 1000")
{
    GateFixture fixture;
    for (int i = 0; i < 150; ++i)
    {
        static_cast<void>(fixture.Post("write"));
    }
    const auto count = [&fixture](const std::string& target) {
        return std::ranges::count(fixture.Ask("GET", "read", target).body, '\n');
    };
    CHECK(count("/v1/audit") == 100);
    CHECK(count("/v1/audit?limit=1") == 1);
    CHECK(count("/v1/audit?limit=1000") == 150);
    for (const char* limit : {"0", "1001", "-1", "1x", "", "99999999999999999999"})
    {
        CAPTURE(limit);
        CHECK(fixture.Ask("GET", "read", std::string("/v1/audit?limit=") + limit).status == 400);
    }
    for (const char* query : {"lines=5", "limit=5&limit=5", "limit=5&plan=P1"})
    {
        CAPTURE(query);
        CHECK(fixture.Ask("GET", "read", std::string("/v1/audit?") + query).status == 400);
    }
}

TEST_CASE("A browser that has shown a token is identified by its cookie until it logs out")
{
    GateFixture fixture;
    int logouts = 0;
    fixture.gate.SetLogoutHandler([&logouts] { ++logouts; });
    const std::string cookie = fixture.Login("write");
    CHECK(fixture.Browse("POST", "/v1/tsc/pause", cookie).status == 202);
    CHECK(fixture.Browse("POST", "/v1/tsc/pause", fixture.Login("read")).status == 403);
    CHECK(fixture.Browse("GET", "/v1/audit", fixture.Login("read")).status == 200);
    Apps::HttpRequest forged = *Apps::ParseHttpTarget("/v1/tsc/pause");
    forged.method = "POST";
    forged.headers = {{"Host", "acs:8081"}, {"Cookie", cookie}};
    CHECK(fixture.gate.Respond(forged).status == 403);
    forged = *Apps::ParseHttpTarget("/v1/logout");
    forged.method = "POST";
    forged.headers = {{"Host", "acs:8081"}, {"Cookie", cookie}};
    CHECK(fixture.gate.Respond(forged).status == 403);
    CHECK(fixture.commands == 1);
    CHECK(logouts == 0);
    CHECK(fixture.Browse("POST", "/v1/logout?all=1", cookie).status == 400);
    CHECK(fixture.Browse("POST", "/v1/logout", cookie, R"({"all":true})").status == 400);
    CHECK(logouts == 0);
    CHECK(fixture.Browse("POST", "/v1/logout", cookie).status == 204);
    CHECK(logouts == 1);
    CHECK(fixture.Browse("POST", "/v1/tsc/pause", cookie).status == 401);
    CHECK(fixture.Browse("POST", "/v1/logout", cookie).status == 204);
    CHECK(logouts == 1);
    const std::string audit = fixture.Ask("GET", "read", "/v1/audit").body;
    CHECK(
        audit.find(
            R"("proof":"token","name":"kim","role":"operator","method":"POST","request":"/v1/login","status":204)")
        != std::string::npos);
    CHECK(
        audit.find(R"("proof":"session","name":"kim","role":"operator","method":"POST","request":"/v1/tsc/pause")")
        != std::string::npos);
    CHECK(
        audit.find(
            R"("proof":"session","name":"kim","role":"operator","method":"POST","request":"/v1/logout","status":204)")
        != std::string::npos);
    CHECK(audit.find("acs_session") == std::string::npos);
}

TEST_CASE("A session ends when its token is withdrawn, and after 12 hours")
{
    GateFixture fixture;
    const std::string kim = fixture.Login("write");
    const std::string grafana = fixture.Login("read");
    fixture.gate.SetPolicy(
        AccessPolicy({{{{EOperatorRole::Viewer, "grafana", Acsd::HashToken("read")}}}, std::nullopt}));
    CHECK(fixture.Browse("GET", "/v1/audit", kim).status == 401);
    CHECK(fixture.Browse("GET", "/v1/audit", grafana).status == 200);
    fixture.clock.Advance(Acsd::SessionTable::LIFETIME);
    CHECK(fixture.Browse("GET", "/v1/audit", grafana).status == 401);
}

TEST_CASE("A login with an unknown token is refused and logged, one without a token is malformed")
{
    GateFixture fixture;
    const Apps::HttpResponse unknown = fixture.Browse("POST", "/v1/login", "", R"({"token":"guess"})");
    CHECK(unknown.status == 401);
    CHECK(unknown.headers.empty());
    CHECK(fixture.log.Contains(Core::ELogLevel::Warning, "Refused a request to the operator interface"));
    CHECK(fixture.Browse("POST", "/v1/login", "", "guess").status == 400);
    CHECK(fixture.Browse("POST", "/v1/login?token=write", "", R"({"token":"write"})").status == 400);
    CHECK(fixture.Browse("GET", "/v1/login", "").status == 405);
    CHECK(fixture.Ask("GET", "read", "/v1/audit").body.empty());
}

TEST_CASE("Without tokens a login is not needed: it is answered with 204 and no cookie")
{
    GateFixture fixture;
    fixture.gate.SetPolicy(AccessPolicy({std::nullopt, std::nullopt}));
    CHECK(fixture.Browse("POST", "/v1/login", "").status == 403); // not of this machine
    Apps::HttpRequest request = *Apps::ParseHttpTarget("/v1/login");
    request.method = "POST";
    request.sender.peer = {"127.0.0.1", 40'000};
    const Apps::HttpResponse response = fixture.gate.Respond(request);
    CHECK(response.status == 204);
    CHECK(response.headers.empty());
}

TEST_CASE("The files of the page are served without identification")
{
    GateFixture fixture;
    CHECK(fixture.Ask("GET", "", "/page/app.css").status == 200);
    CHECK(fixture.Ask("POST", "", "/page/app.css").status == 401);
}

TEST_CASE("A command with a key is executed once, also over a restart, and each repetition is in the audit log")
{
    GateFixture fixture;
    CHECK(fixture.PostWithKey("read", "k").status == 403); // does not take the key
    CHECK(fixture.PostWithKey("write", "k").status == 202);
    CHECK(fixture.PostWithKey("write", "k").status == 202);
    CHECK(fixture.PostWithKey("write", "no key").status == 400);
    CHECK(fixture.commands == 1);
    const std::string audit = fixture.Ask("GET", "read", "/v1/audit").body;
    CHECK(std::ranges::count(audit, '\n') == 4);
    CHECK(audit.find(R"("request":"/v1/tsc/pause","key":"k","digest":")") != std::string::npos);
    CHECK(audit.find(R"(","replay":true,"status":202,"answer":{"message":"paused"}})") != std::string::npos);

    Acsd::OperatorGate restarted(
        fixture.clock,
        Core::Logger(fixture.log, "operator"),
        AccessPolicy({{{{EOperatorRole::Operator, "kim", Acsd::HashToken("write")}}}, std::nullopt}),
        *fixture.audit);
    REQUIRE(fixture.receipts.size() == 1);
    restarted.Restore(fixture.receipts);
    Apps::HttpRequest request = *Apps::ParseHttpTarget("/v1/tsc/pause");
    request.method = "POST";
    request.sender = {{"10.0.0.7", 40'000}, "Bearer write"};
    request.headers = {{"Idempotency-Key", "k"}};
    const Apps::HttpResponse replayed = restarted.Respond(request);
    CHECK(replayed.status == 202);
    CHECK(replayed.body == "{\"message\":\"paused\"}\n");
}
