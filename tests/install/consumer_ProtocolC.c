// needs: nothing
#include <acs/c/acs_protocol.h>

#include <stdio.h>
#include <string.h>

int main(void)
{
    const char text[] = "{\"command\":\"CancelPlan\",\"transactionId\":\"t\",\"payload\":{\"planId\":\"P\"}}";
    acs_codec* codec = NULL;
    acs_message message;
    memset(&message, 0, sizeof message);
    message.struct_size = sizeof message;
    if (acs_codec_create(ACS_C_ABI_VERSION, NULL, &codec) != ACS_OK
        || acs_codec_decode(codec, text, sizeof text - 1, &message) != ACS_OK)
    {
        return 1;
    }
    puts(message.text.data);
    acs_codec_destroy(codec);
    return 0;
}
