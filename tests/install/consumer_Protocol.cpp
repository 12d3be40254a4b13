// needs: nothing
#include <acs/protocol/AcsCodec.hpp>

#include <cstdio>
#include <string>

int main()
{
    ACS::Protocol::AcsCodec codec;
    const ACS::Protocol::DecodeOutcome outcome =
        codec.Decode(R"({"command":"CancelPlan","transactionId":"t","payload":{"planId":"P"}})");
    std::string text;
    if (outcome.message.has_value())
    {
        ACS::Protocol::AcsCodec::Encode(*outcome.message, text);
    }
    std::puts(text.c_str());
    return text.find(R"("planId":"P")") == std::string::npos ? 1 : 0;
}
