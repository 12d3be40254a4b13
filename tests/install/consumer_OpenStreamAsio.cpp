// needs: Boost
#include <acs/openstream_asio/OpenStreamClient.hpp>

#include <type_traits>

int main()
{
    const ACS::OpenStreamAsio::OpenStreamClientOptions options;
    static_assert(!std::is_copy_constructible_v<ACS::OpenStreamAsio::OpenStreamClient>);
    void (ACS::OpenStreamAsio::OpenStreamClient::*start)() = &ACS::OpenStreamAsio::OpenStreamClient::Start;
    return options.port == 49'000 && start != nullptr ? 0 : 1;
}
