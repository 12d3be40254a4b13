#include "Catch.hpp"
#include "HeapProbe.hpp"
#include "ManualClock.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/openstream/ServerSession.hpp>

#include <chrono>
#include <cstdint>
#include <string>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ACS::Core::JsonText;
using ACS::Testing::HeapProbe;

namespace
{

constexpr int TICKS = 1000;

/// A session whose service writes each sample into the memory of the last one, and whose socket sends everything.
class BareServer
{
    ACS::Testing::ManualClock _clock;
    ServerSession _session;
    ServerActions _actions;
    ApiResponse _response;
    std::uint64_t _sampleCount = 0;

public:
    std::uint64_t bytes = 0;
    bool bSocketTakes = true;

    void Receive(std::string_view text)
    {
        _session.OnBytes(text, _clock.GetNow(), _actions);
        Execute();
    }

    void Tick()
    {
        _clock.Advance(2ms);
        _session.OnTimer(EServerTimer::MonitorTick, _clock.GetNow(), _actions);
        Execute();
    }

    [[nodiscard]] const ServerSessionStats& GetStats() const
    {
        return _session.GetStats();
    }

private:
    void Do(const ServerSend& action)
    {
        bytes += action.text.size();
        if (bSocketTakes)
        {
            _session.OnSendCompleted(_clock.GetNow(), _actions);
        }
    }

    void Do(const ServerCall& action)
    {
        std::string text = _response.TakeRoom();
        text = R"({"_type":"JObject","position":[0.949533,90.949655,-1.5,0.25,45.125,3.75],"count":)";
        text += static_cast<char>('0' + ++_sampleCount % 10);
        text += '}';
        _response.body = JsonText::FromTrusted(std::move(text));
        _session.OnServiceAnswer(action.token, _response, _clock.GetNow(), _actions);
    }

    template <typename TAction>
    void Do(const TAction& /*action*/)
    {
    }

    void Execute()
    {
        std::size_t index = 0;
        while (index < _actions.size()) // grows underway
        {
            const ServerAction action = _actions[index];
            std::visit([this](const auto& content) { Do(content); }, action);
            ++index;
        }
        _actions.clear();
    }
};

void Stream(BareServer& server)
{
    server.Receive("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n"
                   "{\"cmd\":\"MONITOR\",\"payload\":{\"url\":\"/a\",\"method\":\"GET\",\"period_ms\":2,"
                   "\"args\":{\"jno_start\":1},\"id\":1}}\n");
}

} // namespace

TEST_CASE("The probe counts a text that outgrows its memory")
{
    const std::uint64_t blocks = HeapProbe::GetBlockCount();
    const std::string text(1000, 'x');
    CHECK(text.size() == 1000);
    CHECK(HeapProbe::GetBlockCount() == blocks + 1);
}

TEST_CASE("8 A tick of the MONITOR allocates nothing")
{
    BareServer server;
    Stream(server);
    for (int count = 0; count < TICKS; ++count)
    {
        server.Tick(); // the texts reach their size
    }
    const std::uint64_t before = HeapProbe::GetBlockCount();
    const std::uint64_t bytes = server.bytes;
    for (int count = 0; count < TICKS; ++count)
    {
        server.Tick();
    }
    CHECK(HeapProbe::GetBlockCount() == before);
    CHECK(server.GetStats().dataLines == 2U * TICKS);
    CHECK(server.bytes - bytes > 100U * TICKS);
}

TEST_CASE("8 7.26 A tick for a reader that is too slow allocates nothing either")
{
    BareServer server;
    Stream(server);
    server.Tick();
    server.bSocketTakes = false;
    for (int count = 0; count < 10; ++count)
    {
        server.Tick();
    }
    const std::uint64_t before = HeapProbe::GetBlockCount();
    for (int count = 0; count < TICKS; ++count)
    {
        server.Tick();
    }
    CHECK(HeapProbe::GetBlockCount() == before);
    CHECK(server.GetStats().replacedLines >= TICKS);
}
