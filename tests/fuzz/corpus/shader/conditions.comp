#ifdef A
#ifndef B
#else
#endif
#endif
#undef A
#if 1 // x
#endif
﻿