// needs: nothing
#include <acs/core/Result.hpp>
#include <acs/core/Version.hpp>

#if ACS_VERSION_MAJOR == 0 && ACS_VERSION_MINOR < 1
#error "the version is older than 0.1"
#endif

#include <cstdio>

int main()
{
    const tl::unexpected<ACS::Core::Error> failure =
        ACS::Core::Fail(ACS::Core::ECoreError::OutOfRange, "payload.x", "a number", "a word");
    const std::string sentence = ACS::Core::Describe(failure.value());
    std::puts(sentence.c_str());
    return sentence.find("payload.x") == std::string::npos ? 1 : 0;
}
