#pragma once

#include "ActionRecorder.hpp"
#include "Fixture.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/McsSession.hpp>

#include <string>

namespace ACS::Testing
{

/// An MCS side, and the texts of an ACS to it.
class McsSessionFixture
{
public:
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    Protocol::McsSession session;
    Testing::ActionRecorder recorder;

    explicit McsSessionFixture(bool bSecondRefused = false)
        : McsSessionFixture(MakeOptions(bSecondRefused))
    {
    }

    explicit McsSessionFixture(const Protocol::McsSessionOptions& options)
        : session(options, random)
    {
    }

    static Protocol::McsSessionOptions MakeOptions(bool bSecondRefused)
    {
        Protocol::McsSessionOptions options;
        options.bSecondRefused = bSecondRefused;
        return options;
    }

    void Text(Protocol::ConnectionID connection, const std::string& text)
    {
        recorder.Clear();
        session.OnText(connection, text, clock.GetNow(), recorder.out);
    }

    void Expire(Protocol::ESessionTimer timer)
    {
        recorder.Clear();
        session.OnTimer(timer, clock.GetNow(), recorder.out);
    }

    [[nodiscard]] bool TryAnswer(
        Protocol::AnswerToken token,
        Protocol::EAckResult result = Protocol::EAckResult::Success,
        const std::string& message = "Stored.")
    {
        recorder.Clear();
        return session.TryAnswer(token, result, message, clock.GetNow(), recorder.out);
    }

    void Register(Protocol::ConnectionID connection)
    {
        session.OnConnected(connection, clock.GetNow(), recorder.out);
        Text(connection, MakeRequestText("Registration", "{}", "r-" + std::to_string(connection)));
    }
};

} // namespace ACS::Testing
