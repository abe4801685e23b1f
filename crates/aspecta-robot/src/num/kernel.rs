//! Functions compiled for more than one processor.

/// `kernel!({generics} (name: type, …) -> type { body })` runs a body on references as one outlined call, compiled for AVX2 where the
/// processor has it.
///
/// Neither intervals nor affine forms use fused operations, so the bits do not depend on the instructions. The 3-RRR's paving takes
/// 0.75 times as long with it (`docs/performance.md`).
macro_rules! kernel {
    ({$($generics:tt)*} ($($arg:ident: $type:ty),*) -> $out:ty $body:block) => {{
        #[inline(always)]
        fn body<$($generics)*>($($arg: $type),*) -> $out $body

        #[inline(never)]
        fn plain<$($generics)*>($($arg: $type),*) -> $out {
            body($($arg),*)
        }

        #[cfg(target_arch = "x86_64")]
        {
            #[inline(never)]
            #[target_feature(enable = "avx2")]
            fn wide<$($generics)*>($($arg: $type),*) -> $out {
                body($($arg),*)
            }
            if is_x86_feature_detected!("avx2") {
                // SAFETY: the processor has the feature, as just checked.
                #[allow(unsafe_code)]
                return unsafe { wide($($arg),*) };
            }
        }
        plain($($arg),*)
    }};
}
pub(super) use kernel;
