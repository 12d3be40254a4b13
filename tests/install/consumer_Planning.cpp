// needs: nothing
#include <acs/plan/LifReader.hpp>

#include <cstdio>

int main()
{
    const ACS::Core::Result<ACS::Planning::SiteMap> site = ACS::Planning::DecodeLIF("{}");
    const std::string sentence = site.has_value() ? std::string() : ACS::Core::Describe(site.error());
    std::puts(sentence.c_str());
    return sentence.find("metaInformation") == std::string::npos ? 1 : 0;
}
