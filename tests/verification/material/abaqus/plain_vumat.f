c     Copyright 2026 The periporo authors
c     SPDX-License-Identifier: BSD-3-Clause
c
c     Each component of stress grows with its own strain alone. Its include file is that of the page of abaqus_user_material.
      subroutine vumat(nblock,ndir,nshr,nstatev,nfieldv,nprops,
     1 lanneal,stepTime,totalTime,dt,cmname,coordMp,charLength,
     2 props,density,strainInc,relSpinInc,tempOld,stretchOld,
     3 defgradOld,fieldOld,stressOld,stateOld,enerInternOld,
     4 enerInelasOld,tempNew,stretchNew,defgradNew,fieldNew,
     5 stressNew,stateNew,enerInternNew,enerInelasNew)
      include 'VABA_PARAM.INC'
      dimension props(nprops),strainInc(nblock,ndir+nshr),
     1 stressOld(nblock,ndir+nshr),stressNew(nblock,ndir+nshr)
      character*80 cmname
      do k = 1, nblock
        do i = 1, ndir + nshr
          stressNew(k,i) = stressOld(k,i) + props(1)*strainInc(k,i)
        end do
      end do
      end
