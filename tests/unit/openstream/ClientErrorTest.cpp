#include "Catch.hpp"
#include "ClientFixture.hpp"

#include <array>
#include <string>
#include <variant>
#include <vector>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;    // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

/// The effect of a code while a MONITOR, a CONTROL or nothing is in flight: M, C reject it, F is a ClientControlFault,
/// R is reported, S means stopped, L ends the session, - leads to no event.
struct CodeRow
{
    const char* code;
    char onMonitor;
    char onControl;
    char onNothing;
};

constexpr std::array CODES{
    CodeRow{"invalid_ndjson", 'M', 'C', 'F'},
    CodeRow{"rx_buf_overflow", 'L', 'L', 'L'},
    CodeRow{"handshake_required", 'L', 'L', 'L'},
    CodeRow{"version_mismatch", 'R', 'R', 'R'},
    CodeRow{"busy_session_active", 'R', 'R', 'R'},
    CodeRow{"handshake_rejected", 'L', 'L', 'L'},
    CodeRow{"session_timeout", 'L', 'L', 'L'},
    CodeRow{"invalid_cmd", 'M', 'C', 'F'},
    CodeRow{"invalid_payload", 'M', 'C', 'F'},
    CodeRow{"missing_field", 'M', 'C', 'F'},
    CodeRow{"invalid_type", 'M', 'C', 'F'},
    CodeRow{"invalid_value", 'M', 'C', 'F'},
    CodeRow{"missing_major", 'R', 'R', 'R'},
    CodeRow{"invalid_major_type", 'R', 'R', 'R'},
    CodeRow{"invalid_version", 'R', 'R', 'R'},
    CodeRow{"missing_url", 'M', 'C', 'F'},
    CodeRow{"invalid_url", 'M', 'C', 'F'},
    CodeRow{"url_too_long", 'M', 'C', 'F'},
    CodeRow{"missing_method", 'M', 'C', 'F'},
    CodeRow{"invalid_method", 'M', 'C', 'F'},
    CodeRow{"missing_period_ms", 'M', 'R', 'R'},
    CodeRow{"invalid_period", 'M', 'R', 'R'},
    CodeRow{"invalid_args", 'M', 'C', 'F'},
    CodeRow{"invalid_body", 'F', 'C', 'F'},
    CodeRow{"monitor_already_active", '-', 'R', 'R'}, // stop and retry
    CodeRow{"monitor_internal_error", 'R', 'R', 'R'},
    CodeRow{"method_not_allowed", 'F', 'C', 'F'},
    CodeRow{"control_busy", 'F', 'C', 'F'},
    CodeRow{"control_err", 'F', 'C', 'F'},
    CodeRow{"missing_target", 'R', 'R', 'R'},
    CodeRow{"invalid_target", 'R', 'R', 'R'},
    CodeRow{"nothing_to_stop", 'S', 'S', 'S'},
    CodeRow{"stop_failed", 'L', 'L', 'L'},
    CodeRow{"code_of_a_later_version", 'M', 'C', 'F'},
};

std::string MakeError(const char* code)
{
    return R"({"error":")" + std::string(code) + R"(","message":"why","hint":"what to do"})" + "\n";
}

char GetLetter(const ClientFixture& client)
{
    for (const ClientEvent& event : client.events)
    {
        if (const auto* settled = std::get_if<ClientControlSettled>(&event))
        {
            return settled->outcome == EControlOutcome::Refused ? 'C' : 'U';
        }
        if (std::holds_alternative<ClientMonitorRefused>(event))
        {
            return 'M';
        }
        if (std::holds_alternative<ClientControlFault>(event))
        {
            return 'F';
        }
        if (std::holds_alternative<ClientErrorReported>(event))
        {
            return 'R';
        }
        if (std::holds_alternative<ClientStopped>(event))
        {
            return 'S';
        }
        if (std::holds_alternative<ClientLost>(event))
        {
            return 'L';
        }
    }
    return '-';
}

} // namespace

TEST_CASE("4 The table has every code")
{
    REQUIRE(CODES.size() == static_cast<std::size_t>(EOpenStreamErrorCode::Unknown));
    for (const CodeRow& row : CODES)
    {
        INFO(row.code);
        const auto number = static_cast<EOpenStreamErrorCode>(&row - CODES.data() + 1);
        CHECK(GetErrorCode(row.code) == number);
    }
}

TEST_CASE("4 7.16 7.19 Each code while a MONITOR is in flight")
{
    for (const CodeRow& row : CODES)
    {
        INFO(row.code);
        ClientFixture client;
        MakeReady(client);
        client.SetMonitor(10ms);
        client.Receive(MakeError(row.code));
        CHECK(GetLetter(client) == row.onMonitor);
    }
}

TEST_CASE("4 7.15 7.16 Each code while a CONTROL is in flight")
{
    for (const CodeRow& row : CODES)
    {
        INFO(row.code);
        ClientFixture client;
        MakeReady(client);
        const std::uint64_t token = client.Control("/a");
        client.Receive(MakeError(row.code));
        if (row.onControl == 'L')
        {
            const auto settled = client.Take<ClientControlSettled>();
            REQUIRE(settled.size() == 1);
            CHECK(settled.at(0).outcome == EControlOutcome::Unknown);
        }
        CHECK(GetLetter(client) == row.onControl);
        if (row.onControl == 'C')
        {
            const auto settled = client.Take<ClientControlSettled>();
            CHECK(settled.at(0).token == token);
            CHECK(settled.at(0).status >= 400);
            CHECK(settled.at(0).detail == std::string(row.code) + ": why; hint: what to do");
        }
    }
}

TEST_CASE("4 Each code while nothing is in flight")
{
    for (const CodeRow& row : CODES)
    {
        INFO(row.code);
        ClientFixture client;
        MakeReady(client);
        client.Receive(MakeError(row.code));
        CHECK(GetLetter(client) == row.onNothing);
        for (const ClientControlFault& fault : client.Take<ClientControlFault>())
        {
            CHECK(fault.status == GetErrorStatus(GetErrorCode(row.code)));
            CHECK(fault.status >= 400);
            CHECK_FALSE(fault.body.has_value());
        }
        CHECK((client.session.GetState() == EClientState::Ready) == (row.onNothing != 'L'));
    }
}

TEST_CASE("4 Each code in answer to the HANDSHAKE leads to a reconnect")
{
    for (const CodeRow& row : CODES)
    {
        INFO(row.code);
        ClientFixture client;
        client.Start();
        client.session.OnConnected(client.GetNow(), client.actions);
        client.Execute();
        client.Receive(MakeError(row.code));
        const auto lost = client.Take<ClientLost>();
        REQUIRE(lost.size() == 1);
        CHECK(lost.at(0).reason == EClientLossReason::HandshakeFailed);
        client.Pass(lost.at(0).retryIn);
        CHECK(client.connects == 2);
    }
}

TEST_CASE("4 7.19 Each code in answer to STOP monitor or STOP session ends the stream or the session")
{
    for (const CodeRow& row : CODES)
    {
        INFO(row.code);
        ClientFixture client;
        client.SetMonitor(10ms);
        MakeReady(client);
        client.Receive(MONITOR_ACK);
        client.session.SetMonitor(std::nullopt, client.GetNow(), client.actions);
        client.Execute();
        CHECK(client.CountLines("STOP") == 1);
        client.Receive(MakeError(row.code));
        client.session.Stop(client.GetNow(), client.actions);
        client.Execute();
        client.Receive(MakeError(row.code));
        CHECK(client.Take<ClientEnded>().size() == 1);
        CHECK(client.session.GetState() == EClientState::Stopped);
    }
}

TEST_CASE("7.5 ts is of any clock of the server: only its increase within one stream counts")
{
    ClientFixture client;
    client.SetMonitor(10ms);
    MakeReady(client);
    client.Receive(MONITOR_ACK);
    for (const char* ts : {"1766000000000", "1766000000010", "1766000000009.6", "5", "15", "25.4", "1766000000000"})
    {
        client.Receive(R"({"type":"data","ts":)" + std::string(ts) + R"(,"svc_dur_ms":0.1,"result":1})" + "\n");
    }
    CHECK(client.session.GetStats().dataLines == 7);
    CHECK(client.session.GetStats().missingLines == 0);
}
