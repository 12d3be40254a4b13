// needs: Boost OpenSSL
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstdio>

namespace
{

class Clock final : public ACS::Core::IClock
{
public:
    [[nodiscard]] ACS::Core::Now GetNow() const override
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }
};

class Random final : public ACS::Core::IRandom
{
public:
    [[nodiscard]] std::uint64_t GetNext() override
    {
        return 4;
    }
};

class Handler final : public ACS::ProtocolBeast::ISessionHandler
{
public:
    void OnSessionEvent(const ACS::Protocol::SessionEvent& /*event*/) override
    {
    }
};

} // namespace

int main()
{
    boost::asio::io_context io;
    const Clock clock;
    Random random;
    Handler handler;
    const auto server = ACS::ProtocolBeast::McsServer::Create(io.get_executor(), clock, random, {}, {}, handler);
    std::puts(server.has_value() ? "listening" : ACS::Core::Describe(server.error()).c_str());
    return server.has_value() && (*server)->GetPort() != 0 ? 0 : 1;
}
